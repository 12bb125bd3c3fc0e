#pragma once
/// Estimates of light from points, or without samples: how the settings choose among them.
///
/// A kind of light is described by a type `Light` for each of its shapes, with
///
///     using Shape: the light in shading space; with a member modulate(surface, sample) if its radiance varies;
///     static LocalLight<Shape> local(reflected, lights, index): one of the lights as a packet of shading points sees it;
///     static technique(TechniqueTag<...>, shape): the technique of each setting but the analytic one;
/// static LobeIntegrals integrals(shape, lobe): in closed form. Kinds without this function are sampled.

#include "render_cpu/kernel/analytic.h"
#include "render_cpu/kernel/paired_techniques.h"
#include "render_cpu/kernel/single_technique.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

template <class Light>
inline constexpr bool kHasIntegrals = requires(const typename Light::Shape& shape, const Ltc<Real>& lobe) {
    Light::integrals(shape, lobe);
};

template <class Light>
render_cpu::AddLight point_samples(const render_cpu::RenderJob& job) noexcept {
    if (job.technique == render::Technique::ltc_analytic) {
        if constexpr (kHasIntegrals<Light>)
            return &add_analytically<Light>;
        else
            return single_technique<Light>(job.technique);
    }
    if (job.strategies == render::Strategies::diffuse) return single_technique<Light>(job.technique);
    return paired_techniques<Light>(job);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
