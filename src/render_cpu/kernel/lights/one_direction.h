#pragma once
/// Lights without extent: each shading point receives their light from one direction. All settings of techniques, strategies
/// and heuristics give the same, because there is nothing to choose.

#include "render_cpu/kernel/analytic.h"
#include "render_cpu/kernel/reflected_light.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// A light without extent in shading space. LocalLight::emission is the irradiance normal to the direction.
struct OneDirection {
    Vector wi; ///< unit direction to the light
    Vector p;  ///< where shadow rays end [m]
};

/// Emission and irradiance are bounded like the radiance of other lights: bright texels, and points next to a light, would
/// overflow.
inline Vector bounded(const Vector& light) noexcept {
    const Real most(1e30f);
    return {min(light.x, most), min(light.y, most), min(light.z, most)};
}

/// A light as a packet of shading points sees it.
/// \param to_light   unit direction in world space
/// \param way        to the point where shadow rays end, in world space
/// \param usable     lanes in which the light has a direction
/// \param normal_irradiance of surfaces normal to the direction
inline LocalLight<OneDirection> light_in_direction(const ReflectedLight& reflected, const Vector& to_light,
                                                   const Vector& way, LaneMask usable,
                                                   const Vector& normal_irradiance,
                                                   std::int32_t number) noexcept {
    const Vector irradiance = bounded(normal_irradiance);
    const Frame<Real>& frame = reflected.surface().frame;
    const Vector wi = frame.to_local(to_light);
    // Comparisons with NaN are false. Negated, they keep NaN, so that it is counted.
    const auto is_black = max(max(irradiance.x, irradiance.y), irradiance.z) <= Real(0);
    const LaneMask lit = reflected.lanes() & usable & !(wi.z <= Real(0)) & !is_black;
    return {{wi, frame.to_local(way)}, lit, irradiance, static_cast<std::uint32_t>(number)};
}

/// Adds the light from its only direction, with one shadow ray however many samples the job takes.
template <class Light>
void add_from_one_direction(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                            std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const LocalLight<OneDirection> light = Light::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const OneDirection& way = light.shape;
    const Vector zero{Real(0), Real(0), Real(0)};
    const DirectLightSample<Real> sample{way.wi, way.p,
                                         way.wi.z * reflected.surface().glossy.brdf.eval(way.wi), zero};
    ReflectedLight once = reflected.with(light.lit, 1);
    once.add(light,
             [&](std::uint32_t /*number*/, SampleSum& sum) { once.add_sample(way, light.lit, sample, sum); });
    reflected.add(once);
}

/// What analytic shading knows of a light without extent: the densities of both lobes in its direction.
inline LobeIntegrals lobes_in_direction(const OneDirection& way, const Ltc<Real>& lobe) noexcept {
    return {Real(1 / kPi<float>) * way.wi.z, lobe.density(way.wi)};
}

/// The function for a job. \tparam Light has local() and integrals(), see point_samples.h
template <class Light>
render_cpu::AddLight one_direction(const render_cpu::RenderJob& job) noexcept {
    if (job.technique == render::Technique::ltc_analytic) return &add_analytically<Light>;
    return &add_from_one_direction<Light>;
}

/// The code of a kind of light. \tparam Light see one_direction()
template <class Light>
render_cpu::LightCode one_direction_code() noexcept {
    const auto choose = [](const render_cpu::RenderJob& job,
                           render_cpu::AddLight(&add)[render_cpu::kMostShapes]) noexcept {
        add[0] = one_direction<Light>(job);
    };
    const auto shape_of = [](const render_cpu::LightSet&, std::int32_t) noexcept { return std::int32_t(0); };
    // No ray meets it.
    const auto emission = [](const render_cpu::LightSet&, std::int32_t, const scene::Float3&,
                             const scene::Float3&) noexcept {
        return scene::Float3{0, 0, 0};
    };
    return {choose, shape_of, emission};
}

} // namespace kernel
NUSSELT_NAMESPACE_END
