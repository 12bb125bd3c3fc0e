#include "render_cpu/kernel/light_functions.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

using render::Mis;

/// The heuristic of the job. That it branches costs next to nothing: all lanes and samples go the same way.
struct ChosenHeuristic {
    Mis mis;
    Real visibility;

    template <int J, int K>
    MisEstimate<Real> estimate(const MisTechniques<Real, K>& techniques,
                               const MisSample<Real, K>& sample) const noexcept {
        switch (mis) {
        case Mis::balance:
            return BalanceHeuristic().estimate<J>(techniques, sample);
        case Mis::power:
            return PowerHeuristic().estimate<J>(techniques, sample);
        case Mis::weighted_balance:
            return WeightedBalanceHeuristic().estimate<J>(techniques, sample);
        case Mis::optimal:
            return OptimalHeuristic<Real>{visibility}.template estimate<J>(techniques, sample);
        case Mis::separate:
            return SeparateComponents().estimate<J>(techniques, sample);
        case Mis::clamped_optimal:
        case Mis::one_sample:
            break;
        }
        return ClampedOptimalHeuristic<Real>{visibility}.template estimate<J>(techniques, sample);
    }
};

template <class Pair, class Shape>
void add_light(ReflectedLight& reflected, const LocalLight<Shape>& light) noexcept {
    if (!any(light.lit)) return;
    const auto& surface = reflected.surface().glossy;
    const LaneMask glossy = light.lit & surface.is_glossy();
    if (!any(glossy)) {
        add_samples(reflected, light, Pair::diffuse(light.shape, surface));
        return;
    }
    const render_cpu::RenderJob& job = reflected.job();
    const DirectLight<Real, Shape, SurfaceBrdf, Pair> estimator(light.shape, surface);
    if (job.mis == Mis::one_sample) {
        reflected.add(light, [&](std::uint32_t number, SampleSum& sum) {
            reflected.add_sample(light.lit, estimator.sample_one(reflected.random(light, number, kPointPair)),
                                 sum);
        });
        return;
    }
    const ChosenHeuristic heuristic{job.mis, Real(job.visibility_estimate)};
    reflected.add(light, [&](std::uint32_t number, SampleSum& sum) {
        reflected.add_sample(
            light.lit, estimator.sample_diffuse(heuristic, reflected.random(light, number, kPointPair)), sum);
        reflected.add_sample(
            glossy, estimator.sample_specular(heuristic, reflected.random(light, number, kSpecularPointPair)),
            sum);
    });
}

template <class Pair, int N>
void add_polygon(ReflectedLight& reflected, std::int32_t index) noexcept {
    add_light<Pair>(reflected, reflected.polygon<N>(index));
}

template <class Pair>
void add_line(ReflectedLight& reflected, std::int32_t index) noexcept {
    add_light<Pair>(reflected, reflected.line(index));
}

template <class Pair>
void add_tube(ReflectedLight& reflected, std::int32_t index) noexcept {
    add_light<Pair>(reflected, reflected.tube(index));
}

template <class PolygonPair, class LinePair>
LightFunctions functions() noexcept {
    return {&add_polygon<PolygonPair, 4>, &add_polygon<PolygonPair, 8>, &add_line<LinePair>,
            &add_tube<LinePair>};
}

/// For sampling of the BRDF: lines and tubes have samples of one technique only.
template <class PolygonPair>
LightFunctions brdf_functions(render::Technique technique) noexcept {
    const LightFunctions single = single_technique_functions(technique);
    return {&add_polygon<PolygonPair, 4>, &add_polygon<PolygonPair, 8>, single.add_line, single.add_tube};
}

template <template <class> class Lobe>
LightFunctions brdf_functions_with(render::Technique technique) noexcept {
    if (technique == render::Technique::solid_angle)
        return brdf_functions<SolidAngleAndBrdf<Lobe>>(technique);
    return brdf_functions<ProjectedSolidAngleAndBrdf<Lobe>>(technique);
}

template <class R>
using VisibleNormals = GgxVisibleNormals<R>;

} // namespace

LightFunctions paired_technique_functions(const render_cpu::RenderJob& job) noexcept {
    switch (job.strategies) {
    case render::Strategies::diffuse_ggx:
        return brdf_functions_with<VisibleNormals>(job.technique);
    case render::Strategies::diffuse_ggx_bounded:
        return brdf_functions_with<GgxBoundedVisibleNormals>(job.technique);
    case render::Strategies::diffuse_ltc:
    case render::Strategies::diffuse:
        break;
    }
    if (job.technique == render::Technique::projected_solid_angle_biased)
        return functions<BiasedProjectedSolidAngleAndLtc, ProjectedSolidAngleAndLtc>();
    return functions<ProjectedSolidAngleAndLtc, ProjectedSolidAngleAndLtc>();
}

} // namespace kernel
NUSSELT_NAMESPACE_END
