#pragma once
/// Analytic light: integrals of linearly transformed cosines, without samples or shadows.

#include "render_cpu/kernel/reflected_light.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Integrals over a light with an emission of 1.
struct LobeIntegrals {
    Real diffuse;  ///< of the clamped cosine over pi
    Real specular; ///< of the specular lobe
};

template <class Light>
void add_analytically(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                      std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = Light::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const auto& surface = reflected.surface().glossy;
    const LobeIntegrals integrals = Light::integrals(light.shape, surface.lobe);
    const Vector diffuse = integrals.diffuse * surface.diffuse_albedo;
    const Vector specular = integrals.specular * surface.specular_albedo;
    reflected.add_known(light, {diffuse + specular, diffuse});
}

} // namespace kernel
NUSSELT_NAMESPACE_END
