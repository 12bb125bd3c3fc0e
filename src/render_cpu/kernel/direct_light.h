#pragma once
/// Light that arrives at surfaces directly from lights.

#include "render_cpu/kernel/camera_packet.h"
#include "render_cpu/kernel/emission.h"
#include "render_cpu/kernel/reflected_light.h"
#include "render_cpu/kernel/surface.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// A light selector that selects all lights. Selectors choose the lights that illuminate a packet of surfaces: they
/// call a function with the number of each among all lights of the scene.
struct AllLights {
    template <class Visit>
    void operator()(const render_cpu::KernelScene& scene, const Visit& visit) const noexcept {
        for (std::int32_t number = 0; number < scene.light_count; ++number) visit(number);
    }
};

/// \param number among all lights of the scene
inline void add_light(ReflectedLight& reflected, std::int32_t number) noexcept {
    if (reflected.stop().is_urgent()) return;
    const render_cpu::LightSet& lights = set_of(reflected.job().scene, number);
    const std::int32_t index = number - lights.first;
    lights.add[lights.code.shape_of(lights, index)](reflected, lights, index);
}

/// The radiance from the selected lights that surfaces reflect. Adds it to the layers.
template <class Selector>
Vector direct_light(const CameraPacket& packet, const Surface& surface,
                    const Selector& select_lights) noexcept {
    ReflectedLight reflected(packet.job, packet.block, surface, packet.camera_ray, packet.layers,
                             packet.line_memory, packet.stop, packet.statistics);
    select_lights(packet.job.scene, [&](std::int32_t number) { add_light(reflected, number); });
    return reflected.radiance();
}

/// The radiance that rays receive from the lights they hit, plus the light of the selected lights that the surfaces
/// they hit reflect.
template <class Selector>
Vector emitted_and_direct_light(const CameraPacket& packet, const Rays& rays,
                                const Selector& select_lights) noexcept {
    const visibility::HitPacket<kLanes> hits = trace(packet, rays);
    std::uint32_t on_triangle = 0;
    std::uint32_t on_light = 0;
    for (int i = 0; i < kLanes; ++i) {
        on_triangle |= static_cast<std::uint32_t>(hits.triangle[i] >= 0) << i;
        on_light |= static_cast<std::uint32_t>(hits.light[i] >= 0) << i;
    }
    const Vector emitted = emission(packet.job.scene, hits, rays);
    if (packet.layers != nullptr) {
        packet.layers->add_hits(hits, LaneMask::from_bits(on_triangle | on_light), rays.direction);
        packet.layers->add_emission(hits, emitted, rays.origin, rays.direction);
    }
    if (on_triangle == 0) return emitted;

    const Surface surface =
        make_surface(packet.job.scene, hits, LaneMask::from_bits(on_triangle), -normalize(rays.direction));
    if (packet.layers != nullptr) packet.layers->add_surface(surface);
    return emitted + direct_light(packet, surface, select_lights);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
