#pragma once
/// Lights that rays hit as surfaces.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/camera_packet.h"
#include "render_cpu/kernel/lanes.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The set that contains a light. \param number among all lights of the scene
inline const render_cpu::LightSet& set_of(const render_cpu::KernelScene& scene,
                                          std::int32_t number) noexcept {
    const render_cpu::LightSet* set = scene.light_sets;
    while (number >= set->first + set->count) ++set;
    return *set;
}

/// Number of the light that a ray hits, -1 for none.
inline std::int32_t light_of_hit(const render_cpu::KernelScene& scene,
                                 const visibility::HitPacket<kLanes>& hits, int lane) noexcept {
    if (hits.light[lane] >= 0) return hits.light[lane];
    return hits.triangle[lane] < 0 ? -1 : scene.triangle_light[hits.triangle[lane]];
}

/// The radiance that rays receive from the lights they hit.
inline Vector emission(const render_cpu::KernelScene& scene, const visibility::HitPacket<kLanes>& hits,
                       const Rays& rays) noexcept {
    Indices light;
    bool any_light = false;
    for (int i = 0; i < kLanes; ++i) {
        light.lane[i] = light_of_hit(scene, hits, i);
        any_light |= light.lane[i] >= 0;
    }
    Lanes result{};
    if (!any_light) return load(result);
    const Lanes o = store(rays.origin);
    const Lanes d = store(rays.direction);
    for (int i = 0; i < kLanes; ++i) {
        if (light.lane[i] < 0) continue;
        const render_cpu::LightSet& lights = set_of(scene, light.lane[i]);
        const scene::Float3 emitted = lights.code.emission(
            lights, light.lane[i] - lights.first, {o.x[i], o.y[i], o.z[i]}, {d.x[i], d.y[i], d.z[i]});
        result.x[i] = emitted.x;
        result.y[i] = emitted.y;
        result.z[i] = emitted.z;
    }
    return load(result);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
