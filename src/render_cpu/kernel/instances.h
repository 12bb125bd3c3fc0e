#pragma once
/// Transforms from object space to world space.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The instances that a packet hits.
struct InstanceLanes {
    Indices number; ///< meaningless if the mask is empty
    LaneMask mask;  ///< lanes that hit an instance
};

inline InstanceLanes instance_lanes(const render_cpu::KernelScene& scene,
                                    const visibility::HitPacket<kLanes>& hits) noexcept {
    InstanceLanes result;
    result.mask = LaneMask::from_bits(0);
    if (scene.instances == nullptr) return result;
    std::uint32_t bits = 0;
    for (int i = 0; i < kLanes; ++i) {
        bits |= static_cast<std::uint32_t>(hits.instance[i] >= 0) << i;
        result.number.lane[i] = hits.instance[i] < 0 ? 0 : hits.instance[i];
    }
    result.mask = LaneMask::from_bits(bits);
    return result;
}

/// The transforms of the instances that a packet hits. They leave lanes that hit no instance unchanged.
class WorldFromObject {
public:
    WorldFromObject(const render_cpu::KernelScene& scene, const InstanceLanes& instances) noexcept
        : first_(*scene.instances), instances_(instances) {}

    Vector point(const Vector& p) const noexcept {
        return select(instances_.mask, linear(p) + translation(), p);
    }
    Vector vector(const Vector& v) const noexcept { return select(instances_.mask, linear(v), v); }

    /// Turns the cross product of edges in world space to the side on which it is in object space.
    Vector front(const Vector& n) const noexcept {
        return select(instances_.mask, word(first_.handedness) * n, n);
    }

    /// The result does not have unit length.
    Vector normal(const Vector& n) const noexcept {
        const float* m = first_.normal_from_object;
        return select(instances_.mask, {row(m, n), row(m + 3, n), row(m + 6, n)}, n);
    }

    /// A coordinate in world space whose rounding errors exceed those of a point, including those of Embree's ray in
    /// object space.
    /// \param p     in the object
    /// \param world largest coordinate for lanes without instances
    Real largest_coordinate(const Vector& p, const Real& world) const noexcept {
        const auto component = [&](const float* m) {
            return abs(word(m[0])) * abs(p.x) + abs(word(m[1])) * abs(p.y) + abs(word(m[2])) * abs(p.z) +
                   abs(word(m[3]));
        };
        const float* m = first_.world_from_object;
        const Real largest = max(max(component(m), component(m + 4)), component(m + 8));
        return select(instances_.mask, word(first_.rounding) * largest, world);
    }

private:
    /// Loads an entry from the record of each lane's instance.
    Real word(const float& of_first) const noexcept {
        constexpr int kStride = sizeof(render_cpu::InstanceRecord) / sizeof(float);
        return gather_column(&of_first, kStride, 0, instances_.number, instances_.mask);
    }

    Real row(const float* m, const Vector& v) const noexcept {
        return word(m[0]) * v.x + word(m[1]) * v.y + word(m[2]) * v.z;
    }

    Vector linear(const Vector& v) const noexcept {
        const float* m = first_.world_from_object;
        return {row(m, v), row(m + 4, v), row(m + 8, v)};
    }

    Vector translation() const noexcept {
        const float* m = first_.world_from_object;
        return {word(m[3]), word(m[7]), word(m[11])};
    }

    const render_cpu::InstanceRecord& first_;
    const InstanceLanes& instances_;
};

} // namespace kernel
NUSSELT_NAMESPACE_END
