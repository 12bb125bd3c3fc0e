#pragma once
/// Closed-form shading of tubes whose radiance varies along them or depends on the direction.

#include "render_cpu/kernel/lights/line_light.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Adds the light of a tube of uniform radiance, times the mean of radiance that the cells of its axis and the cap that is seen
/// have.
/// \param cells  of the axis, see cell_samples.h
/// \param on_cap radiance
template <class Cells>
void add_tube_integrals(ReflectedLight& reflected, const LocalLight<Tube>& light, const Cells& cells,
                        const Vector& on_cap) noexcept {
    const Surface& surface = reflected.surface();
    const Real radius = light.shape.radius;
    const auto radiance = [&](const TubeIntegral& tube, const Vector& by_cells) {
        const Real both = tube.side + tube.caps;
        const auto lit = both > Real(0);
        const Vector mean = Real(1) / select(lit, both, Real(1)) * (radius * by_cells + tube.caps * on_cap);
        return select(lit, tube.whole(), Real(0)) * mean;
    };
    const Vector diffuse = radiance(TubeLight::diffuse(light.shape), cells.diffuse(light.lit).unshadowed()) *
                           surface.glossy.diffuse_albedo;
    const LaneMask glossy = light.lit & surface.glossy.is_glossy();
    Vector all = diffuse;
    if (any(glossy)) {
        const Ltc<Real>& lobe = surface.glossy.lobe;
        all = all +
              radiance(TubeLight::specular(light.shape, lobe), cells.specular(glossy, lobe).unshadowed()) *
                  surface.glossy.specular_albedo;
    }
    reflected.add_known(light, {all, diffuse});
}

} // namespace kernel
NUSSELT_NAMESPACE_END
