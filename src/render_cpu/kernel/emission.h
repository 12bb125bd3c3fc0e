#pragma once
/// Lights as surfaces that rays hit.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Radiance that rays see of lights themselves.
inline Vector emission(const render_cpu::KernelScene& scene, const visibility::HitPacket<kLanes>& hits,
                       const Vector& direction) noexcept {
    Indices polygon;
    bool any_light = false;
    for (int i = 0; i < kLanes; ++i) {
        polygon.lane[i] = hits.triangle[i] < 0 ? -1 : scene.triangle_light[hits.triangle[i]];
        any_light |= (polygon.lane[i] >= 0) | (hits.tube[i] >= 0);
    }
    Lanes result{};
    if (!any_light) return load(result);
    const Lanes d = store(direction);
    for (int i = 0; i < kLanes; ++i) {
        scene::Float3 emitted{0, 0, 0};
        if (hits.tube[i] >= 0) emitted = scene.line_lights[hits.tube[i]].radiance;
        if (polygon.lane[i] >= 0) {
            const render_cpu::PolygonLightRecord& light = scene.polygon_lights[polygon.lane[i]];
            const Vec3<float> ray{d.x[i], d.y[i], d.z[i]};
            if (light.two_sided != 0 || dot(to_vec(light.normal), ray) < 0) emitted = light.radiance;
        }
        result.x[i] = emitted.x;
        result.y[i] = emitted.y;
        result.z[i] = emitted.z;
    }
    return load(result);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
