#pragma once
/// Lights that rays hit as surfaces.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/camera_packet.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/light_sets.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Number of the light that a ray hits, -1 for none.
inline std::int32_t light_of_hit(const render_cpu::KernelScene& scene,
                                 const visibility::HitPacket<kLanes>& hits, int lane) noexcept {
    if (hits.light[lane] >= 0) return hits.light[lane];
    return hits.triangle[lane] < 0 ? -1 : scene.triangle_light[hits.triangle[lane]];
}

/// Calls a function with the number and the radiance of each light that a ray sees which meets nothing.
template <class Visit>
void visit_background(const render_cpu::KernelScene& scene, const scene::Float3& origin,
                      const scene::Float3& direction, const Visit& visit) noexcept {
    for (std::int32_t k = 0; k < scene.light_set_count; ++k) {
        const render_cpu::LightSet& lights = scene.light_sets[k];
        if (lights.code.background == nullptr) continue;
        for (std::int32_t i = 0; i < lights.count; ++i)
            visit(lights.first + i, lights.code.background(lights, i, origin, direction));
    }
}

inline bool has_background(const render_cpu::KernelScene& scene) noexcept {
    bool found = false;
    for (std::int32_t k = 0; k < scene.light_set_count; ++k)
        found |= scene.light_sets[k].code.background != nullptr && scene.light_sets[k].count > 0;
    return found;
}

/// Whether a ray meets neither surface nor light.
inline bool meets_nothing(const visibility::HitPacket<kLanes>& hits, int lane) noexcept {
    return hits.triangle[lane] < 0 && hits.light[lane] < 0;
}

/// The radiance that rays receive from the lights they hit, or from the background.
inline Vector emission(const render_cpu::KernelScene& scene, const visibility::HitPacket<kLanes>& hits,
                       const Rays& rays) noexcept {
    const bool is_background_lit = has_background(scene);
    Indices light;
    bool any_light = false;
    for (int i = 0; i < kLanes; ++i) {
        light.lane[i] = light_of_hit(scene, hits, i);
        any_light |= light.lane[i] >= 0 || (is_background_lit && meets_nothing(hits, i));
    }
    Lanes result{};
    if (!any_light) return load(result);
    const Lanes o = store(rays.origin);
    const Lanes d = store(rays.direction);
    for (int i = 0; i < kLanes; ++i) {
        if (is_background_lit && meets_nothing(hits, i))
            visit_background(scene, {o.x[i], o.y[i], o.z[i]}, {d.x[i], d.y[i], d.z[i]},
                             [&](std::int32_t, const scene::Float3& radiance) {
                                 result.x[i] += radiance.x;
                                 result.y[i] += radiance.y;
                                 result.z[i] += radiance.z;
                             });
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
