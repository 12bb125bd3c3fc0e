#pragma once
/// Samples of a light from a single technique.

#include "render_cpu/kernel/reflected_light.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// A setting as a type, for which kinds of light choose their technique by overloading.
template <render::Technique technique>
struct TechniqueTag {};

/// Adds the light that one technique alone estimates.
template <class Shape, class Technique>
void add_samples(ReflectedLight& reflected, const LocalLight<Shape>& light,
                 const Technique& technique) noexcept {
    reflected.add(light, [&](std::uint32_t number, SampleSum& sum) {
        const Vec2<Real> u = reflected.random(light, number, kPointPair);
        reflected.add_sample(light.shape, light.lit, reflect(reflected.surface(), draw(technique, u)), sum);
    });
}

template <class Light, render::Technique technique>
void add_by_one_technique(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                          std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = Light::local(reflected, lights, index);
    if (any(light.lit))
        add_samples(reflected, light, Light::technique(TechniqueTag<technique>(), light.shape));
}

/// \tparam Light see point_samples.h
template <class Light>
render_cpu::AddLight single_technique(render::Technique technique) noexcept {
    using render::Technique;
    switch (technique) {
    case Technique::area:
        return &add_by_one_technique<Light, Technique::area>;
    case Technique::solid_angle:
        return &add_by_one_technique<Light, Technique::solid_angle>;
    case Technique::clipped_solid_angle:
        return &add_by_one_technique<Light, Technique::clipped_solid_angle>;
    case Technique::projected_solid_angle_biased:
        return &add_by_one_technique<Light, Technique::projected_solid_angle_biased>;
    case Technique::projected_solid_angle:
    case Technique::ltc_analytic:
        break;
    }
    return &add_by_one_technique<Light, Technique::projected_solid_angle>;
}

} // namespace kernel
NUSSELT_NAMESPACE_END
