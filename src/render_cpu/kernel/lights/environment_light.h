#pragma once
/// What units for environments share.

#include "render_cpu/kernel/lanes.h"
#include "render_cpu/lights/environment_records.h"

#include <nusselt/emission/environment_map.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

using SkyMap = EnvironmentMap<float, render_cpu::kEnvironmentCells>;

inline const render_cpu::EnvironmentRecord& environment_record(const render_cpu::LightSet& lights,
                                                               std::int32_t index) noexcept {
    return static_cast<const render_cpu::EnvironmentRecord*>(lights.records)[index];
}

inline const SkyMap& map_of(const render_cpu::EnvironmentRecord& record) noexcept {
    return *static_cast<const SkyMap*>(record.map);
}

/// A direction of world space in the space of the map.
template <class T>
Vec3<T> to_map(const render_cpu::EnvironmentRecord& record, const Vec3<T>& direction) noexcept {
    const auto along = [&](const scene::Float3& axis) { return dot(broadcast<T>(to_vec(axis)), direction); };
    return {along(record.x_axis), along(record.y_axis), along(record.z_axis)};
}

/// The radiance that arrives from a direction of world space.
inline Vec3<float> radiance_towards(const render_cpu::EnvironmentRecord& record,
                                    const Vec3<float>& direction) noexcept {
    if (record.map == nullptr) return to_vec(record.radiance);
    return map_of(record).radiance.lookup(to_map(record, direction));
}

} // namespace kernel
NUSSELT_NAMESPACE_END
