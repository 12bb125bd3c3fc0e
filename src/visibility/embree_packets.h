#pragma once
/// Packets of rays in the form that Embree takes. Only for code that calls Embree itself.

#include "visibility/embree_api.h"
#include "visibility/embree_scene.h"
#include "visibility/ray_packets.h"
#include "visibility/scene_parts.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace nusselt::visibility {

/// The scene behind RayTracer::context of EmbreeScene::tracer().
inline const TracedScene& traced_scene(const void* context) {
    return *static_cast<const TracedScene*>(context);
}

/// Lanes that Embree can take: without branches, so that it vectorises.
template <int N>
inline void mark_valid_lanes(std::uint32_t active, const RayPacket<N>& rays, int* valid) {
    for (int i = 0; i < N; ++i) {
        float largest = 0;
        bool ordered = rays.t_far[i] >= 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float origin = std::fabs(rays.origin[axis][i]);
            const float direction = std::fabs(rays.direction[axis][i]);
            ordered = ordered & (origin <= kLargestRayCoordinate) & (direction <= kLargestRayCoordinate);
            largest = largest > direction ? largest : direction;
        }
        valid[i] = -static_cast<int>(ordered & (largest > 0) & ((active >> i & 1u) != 0));
    }
}

template <class EmbreeRays, int N>
inline void copy_rays(const RayPacket<N>& rays, EmbreeRays& target) {
    static_assert(sizeof target.org_x == sizeof rays.t_far);
    std::memcpy(target.org_x, rays.origin[0], sizeof target.org_x);
    std::memcpy(target.org_y, rays.origin[1], sizeof target.org_y);
    std::memcpy(target.org_z, rays.origin[2], sizeof target.org_z);
    std::memcpy(target.dir_x, rays.direction[0], sizeof target.dir_x);
    std::memcpy(target.dir_y, rays.direction[1], sizeof target.dir_y);
    std::memcpy(target.dir_z, rays.direction[2], sizeof target.dir_z);
    std::memcpy(target.tfar, rays.t_far, sizeof target.tfar);
    for (int i = 0; i < N; ++i) {
        target.tnear[i] = 0;
        target.time[i] = 0;
        target.mask[i] = ~0u;
        target.id[i] = 0;
        target.flags[i] = 0;
    }
}

/// The differences between the packet widths of Embree.
template <int N>
struct Embree;
template <>
struct Embree<4> {
    using Rays = RTCRay4;
    using RayHits = RTCRayHit4;
    static constexpr auto intersect = rtcIntersect4;
    static constexpr auto occluded = rtcOccluded4;
};
template <>
struct Embree<8> {
    using Rays = RTCRay8;
    using RayHits = RTCRayHit8;
    static constexpr auto intersect = rtcIntersect8;
    static constexpr auto occluded = rtcOccluded8;
};
template <>
struct Embree<16> {
    using Rays = RTCRay16;
    using RayHits = RTCRayHit16;
    static constexpr auto intersect = rtcIntersect16;
    static constexpr auto occluded = rtcOccluded16;
};

/// Closest hits of coherent rays that see surfaces and lights.
template <int N>
struct ClosestHitQuery {
    ClosestHitQuery(std::uint32_t active, const RayPacket<N>& rays) {
        mark_valid_lanes(active, rays, valid);
        copy_rays(rays, packet.ray);
        for (int i = 0; i < N; ++i) packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }

    /// Embree's answer overwrites the packet.
    void trace(const TracedScene& scene) {
        intersect_coherent(Embree<N>::intersect, valid, scene.all, packet);
        // Rays end at what they have met, and keep it where they meet nothing closer.
        if (scene.seen != nullptr) intersect_coherent(Embree<N>::intersect, valid, scene.seen, packet);
    }

    alignas(64) int valid[N]; ///< -1 for lanes to trace, 0 for others
    typename Embree<N>::RayHits packet;
};

/// Whether rays meet a surface.
template <int N>
struct ShadowQuery {
    ShadowQuery(std::uint32_t active, const RayPacket<N>& rays) {
        mark_valid_lanes(active, rays, valid);
        copy_rays(rays, packet);
    }

    /// \copydoc ClosestHitQuery::trace
    void trace(const TracedScene& scene) { find_occluded(Embree<N>::occluded, valid, scene.all, packet); }

    alignas(64) int valid[N]; ///< as above
    typename Embree<N>::Rays packet;
};

} // namespace nusselt::visibility
