#pragma once
/// Packets of rays and hits, and the table of functions through which kernels trace them.
///
/// Plain data without functions: baseline code and kernels compiled for other instruction sets share it.

#include <cstdint>

namespace nusselt::visibility {

/// N rays origin + t * direction, 0 <= t <= t_far, in world space [m]. Directions need no unit length.
template <int N>
struct RayPacket {
    alignas(4 * N) float origin[3][N];
    float direction[3][N];
    float t_far[N];
};

/// The closest hits of N rays. A ray meets a triangle of the scene, the exact surface of a round light, a light that is no
/// surface, or nothing.
template <int N>
struct HitPacket {
    std::int32_t triangle[N]; ///< index into Scene::triangles, -1 for none; for round lights one of theirs
    std::int32_t instance[N]; ///< index into Scene::instances that the triangle is part of, -1 for none
    std::int32_t light[N];    ///< that is no surface: its number among all lights of the scene, -1 for none
    std::int32_t round[N];    ///< round light: its number among all lights of the scene, -1 for none
    /// Barycentric coordinates: the hit is v0 + u (v1 - v0) + v (v2 - v0). For round lights texture coordinates. Meaningless
    /// without a triangle.
    alignas(4 * N) float u[N];
    float v[N];
    float t[N]; ///< of the hit along the ray; meaningless without one
    /// The hit in the coordinates of a round light, see scene::RoundLight; meaningless without one.
    float unit[3][N];
};

/// Functions that trace packets of N rays. Bit i of `active` is lane i. Lanes that are not active, or whose
/// ray is invalid (see EmbreeScene), hit nothing.
template <int N>
struct PacketTracer {
    /// Closest hits of coherent rays that see all lights.
    void (*intersect)(const void* context, std::uint32_t active, const RayPacket<N>& rays,
                      HitPacket<N>& hits);
    /// Bits of those active lanes whose ray meets a triangle; invalid rays count as blocked.
    std::uint32_t (*occluded)(const void* context, std::uint32_t active, const RayPacket<N>& rays);
};

/// A way to trace rays: `static_cast<const PacketTracer<16>&>(tracer)` for packets of 16.
struct RayTracer : PacketTracer<4>, PacketTracer<8>, PacketTracer<16> {
    const void* context; ///< first argument of all functions
};

} // namespace nusselt::visibility
