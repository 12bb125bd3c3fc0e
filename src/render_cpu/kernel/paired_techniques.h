#pragma once
/// Samples of a light from one technique for the diffuse component and one for the specular component.

#include "render_cpu/kernel/single_technique.h"

#include <nusselt/estimate/strategies.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The heuristic of the job. Its branches cost next to nothing, because all lanes and samples take the same one.
struct ChosenHeuristic {
    render::Mis mis;
    Real visibility;

    template <int J, int K>
    MisEstimate<Real> estimate(const MisTechniques<Real, K>& techniques,
                               const MisSample<Real, K>& sample) const noexcept {
        switch (mis) {
        case render::Mis::balance:
            return BalanceHeuristic().estimate<J>(techniques, sample);
        case render::Mis::power:
            return PowerHeuristic().estimate<J>(techniques, sample);
        case render::Mis::weighted_balance:
            return WeightedBalanceHeuristic().estimate<J>(techniques, sample);
        case render::Mis::optimal:
            return OptimalHeuristic<Real>{visibility}.template estimate<J>(techniques, sample);
        case render::Mis::separate:
            return SeparateComponents().estimate<J>(techniques, sample);
        case render::Mis::clamped_optimal:
        case render::Mis::one_sample:
            break;
        }
        return ClampedOptimalHeuristic<Real>{visibility}.template estimate<J>(techniques, sample);
    }
};

template <class Light, class Pair>
void add_by_pair(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                 std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = Light::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const auto& surface = reflected.surface().glossy;
    const LaneMask glossy = light.lit & surface.is_glossy();
    if (!any(glossy)) {
        add_samples(reflected, light, Pair::diffuse(light.shape, surface));
        return;
    }
    const render_cpu::RenderJob& job = reflected.job();
    const DirectLight<Real, typename Light::Shape, SurfaceBrdf, Pair> estimator(light.shape, surface);
    if (job.mis == render::Mis::one_sample) {
        reflected.add(light, [&](std::uint32_t number, SampleSum& sum) {
            reflected.add_sample(light.shape, light.lit,
                                 estimator.sample_one(reflected.random(light, number, kPointPair)), sum);
        });
        return;
    }
    const ChosenHeuristic heuristic{job.mis, Real(job.visibility_estimate)};
    reflected.add(light, [&](std::uint32_t number, SampleSum& sum) {
        reflected.add_sample(light.shape, light.lit,
                             estimator.sample_diffuse(heuristic, reflected.random(light, number, kPointPair)),
                             sum);
        reflected.add_sample(
            light.shape, glossy,
            estimator.sample_specular(heuristic, reflected.random(light, number, kSpecularPointPair)), sum);
    });
}

/// Whether a pair has techniques for a kind of light.
template <class Light, class Pair>
inline constexpr bool kHasPair = requires(const typename Light::Shape& shape, const Surface& surface) {
    Pair::diffuse(shape, surface.glossy);
    Pair::specular(shape, surface.glossy);
};

/// The first of these pairs that has techniques for the light, or the single technique if none has.
template <class Light>
render_cpu::AddLight first_pair(render::Technique technique) noexcept {
    return single_technique<Light>(technique);
}
template <class Light, class Pair, class... Others>
render_cpu::AddLight first_pair(render::Technique technique) noexcept {
    if constexpr (kHasPair<Light, Pair>) return &add_by_pair<Light, Pair>;
    return first_pair<Light, Others...>(technique);
}

template <class Light, template <class> class Lobe>
render_cpu::AddLight pair_with_brdf(render::Technique technique) noexcept {
    if (technique == render::Technique::solid_angle)
        return first_pair<Light, SolidAngleAndBrdf<Lobe>>(technique);
    return first_pair<Light, ProjectedSolidAngleAndBrdf<Lobe>>(technique);
}

template <class R>
using VisibleNormals = GgxVisibleNormals<R>;

/// \tparam Light see point_samples.h
template <class Light>
render_cpu::AddLight paired_techniques(const render_cpu::RenderJob& job) noexcept {
    switch (job.strategies) {
    case render::Strategies::diffuse_ggx:
        return pair_with_brdf<Light, VisibleNormals>(job.technique);
    case render::Strategies::diffuse_ggx_bounded:
        return pair_with_brdf<Light, GgxBoundedVisibleNormals>(job.technique);
    case render::Strategies::diffuse_ltc:
    case render::Strategies::diffuse:
        break;
    }
    if (job.technique == render::Technique::projected_solid_angle_biased)
        return first_pair<Light, BiasedProjectedSolidAngleAndLtc, ProjectedSolidAngleAndLtc>(job.technique);
    return first_pair<Light, ProjectedSolidAngleAndLtc>(job.technique);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
