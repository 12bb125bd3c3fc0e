#pragma once
/// The exact surfaces of round lights where rays hit them.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/light_sets.h"
#include "render_cpu/lights/round_records.h"
#include "visibility/ray_packets.h"

#include <cstdint>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The lanes that hit a round light; the others are 0.
struct RoundPoints {
    LaneMask mask;
    Vector position;         ///< world space [m]
    Vector normal;           ///< to the front, of any length
    Vector along_u, along_v; ///< derivatives of the position by the texture coordinates
    Real coordinate;         ///< at least as large as those that the position comes from [m]
};

/// A linear combination of vectors.
inline Vec3<float> combine(const Vec3<float>& weights, const scene::Float3* v) noexcept {
    return weights.x * to_vec(v[0]) + weights.y * to_vec(v[1]) + weights.z * to_vec(v[2]);
}

inline void set_vector(Lanes& lanes, int i, const Vec3<float>& v) noexcept {
    lanes.x[i] = v.x;
    lanes.y[i] = v.y;
    lanes.z[i] = v.z;
}

inline float largest(const Vec3<float>& v) noexcept {
    const float x = __builtin_fabsf(v.x), y = __builtin_fabsf(v.y), z = __builtin_fabsf(v.z);
    return x > y ? (x > z ? x : z) : (y > z ? y : z);
}

inline RoundPoints round_points(const render_cpu::KernelScene& scene,
                                const visibility::HitPacket<kLanes>& hits) noexcept {
    std::uint32_t bits = 0;
    for (int i = 0; i < kLanes; ++i) bits |= static_cast<std::uint32_t>(hits.round[i] >= 0) << i;
    // Most packets hit none.
    const Vector zero{Real(0), Real(0), Real(0)};
    if (bits == 0) return {LaneMask(false), zero, zero, zero, zero, Real(0)};
    constexpr float kPi = 3.14159265f;
    Lanes position{}, normal{}, along_u{}, along_v{}, coordinate{};
    for (int i = 0; i < kLanes; ++i) {
        if (hits.round[i] < 0) continue;
        const render_cpu::LightSet& set = set_of(scene, hits.round[i]);
        const render_cpu::RoundRecord& record =
            static_cast<const render_cpu::RoundRecord*>(set.records)[hits.round[i] - set.first];
        const bool is_flat =
            record.shape == render_cpu::RoundShape::disk || record.shape == render_cpu::RoundShape::ellipse;
        const Vec3<float> p{hits.unit[0][i], hits.unit[1][i], hits.unit[2][i]};
        const Vec3<float> center = to_vec(record.center);
        const Vec3<float> offset = combine(p, record.axis);
        set_vector(position, i, center + offset);
        const float front = record.emits_outwards != 0 ? 1.0f : -1.0f;
        set_vector(normal, i, is_flat ? to_vec(record.normal) : front * combine(p, record.inverse));
        const float radius = __builtin_sqrtf(p.x * p.x + p.y * p.y);
        const float cosine = radius > 0 ? p.x / radius : 1.0f;
        const float sine = radius > 0 ? p.y / radius : 0.0f;
        set_vector(along_u, i, combine({-2 * kPi * p.y, 2 * kPi * p.x, 0}, record.axis));
        const Vec3<float> to_pole = is_flat
                                        ? Vec3<float>{-cosine, -sine, 0}
                                        : Vec3<float>{-kPi * p.z * cosine, -kPi * p.z * sine, kPi * radius};
        set_vector(along_v, i, combine(to_pole, record.axis));
        coordinate.x[i] = largest(center) + largest(offset);
    }
    return {LaneMask::from_bits(bits), load(position), load(normal), load(along_u), load(along_v),
            Real::load(coordinate.x)};
}

} // namespace kernel
NUSSELT_NAMESPACE_END
