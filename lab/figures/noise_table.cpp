#include "lab/figures/noise_table.h"

#include "tables/ltc_table.h"

#include <nusselt/estimate/direct_light.h>
#include <nusselt/random/light_random.h>

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using Real = double;
using Light = ConvexPolygon<Real, 4>;
using Surface = GlossySurface<Real>;
using render::Mis;
using render::Strategies;

/// Half the side of the light, which is at a height of 1 [m].
constexpr Real kHalfSide = 0.5;

std::vector<NoiseTable> make_noise_tables() {
    const Strategies both = Strategies::diffuse_ltc;
    const std::string plastic = "f0 0.04, albedo 0.5";
    const std::string metal = "metal, f0 0.9";
    return {{"planes",
             "Peters 2021, polygonal lights, Fig. 14",
             "Planes under a square light, two samples: standard deviation over mean in percent, in the "
             "highlight / on the plane (largest).",
             {{plastic, 0.5, 0.04}, {metal, 0, 0.9}},
             {0.2, 0.4, 0.6},
             {0, 34, 50, 60, 69, 80},
             {{"weighted_balance", both, Mis::weighted_balance},
              {"clamped_optimal", both, Mis::clamped_optimal},
              {"optimal, v = 1", both, Mis::optimal, 1},
              {"balance", both, Mis::balance},
              {"projected_solid_angle", Strategies::diffuse}},
             {{&Noise::on_plane, "weighted_balance", plastic, 34, 0.025},
              {&Noise::in_highlight, "weighted_balance", metal, 34, 0.025},
              {&Noise::on_plane, "weighted_balance", plastic, 69, 0.15},
              {&Noise::on_plane, "weighted_balance", metal, 69, 0.22}}}};
}

/// One channel of an estimate from two samples.
/// \param u two random points.
template <class Heuristic>
double estimate_with(const DirectLight<Real, Light>& light, const Heuristic& heuristic,
                     const Vec2<Real> (&u)[2]) {
    const auto a = light.sample_diffuse(heuristic, u[0]);
    const auto b = light.sample_specular(heuristic, u[1]);
    return (a.shadowed.x + a.constant.x) + (b.shadowed.x + b.constant.x);
}

double estimate_with_both(const DirectLight<Real, Light>& light, const NoiseEstimator& estimator,
                          const Vec2<Real> (&u)[2]) {
    const Real visibility = estimator.visibility_estimate;
    switch (estimator.mis) {
    case Mis::balance:
        return estimate_with(light, BalanceHeuristic(), u);
    case Mis::power:
        return estimate_with(light, PowerHeuristic(), u);
    case Mis::weighted_balance:
        return estimate_with(light, WeightedBalanceHeuristic(), u);
    case Mis::optimal:
        return estimate_with(light, OptimalHeuristic<Real>{visibility}, u);
    case Mis::separate:
        return estimate_with(light, SeparateComponents(), u);
    case Mis::one_sample:
        return (light.sample_one(u[0]).shadowed.x + light.sample_one(u[1]).shadowed.x) / 2;
    case Mis::clamped_optimal:
        break;
    }
    return estimate_with(light, ClampedOptimalHeuristic<Real>{visibility}, u);
}

/// The mean of two samples of projected solid angle.
double estimate_with_one(const PolygonProjectedSolidAngle<Real, 4>& technique, const Surface& surface,
                         const Vec2<Real> (&u)[2]) {
    double sum = 0;
    for (const Vec2<Real>& point : u) {
        const LightSample<Real> s = technique.sample(point);
        if (s.pdf > 0) sum += surface.brdf.eval(s.wi).x * s.wi.z / s.pdf;
    }
    return sum / 2;
}

/// A shading point with what all estimators need.
struct ShadingPoint {
    ShadingPoint(const Light& light, const Surface& surface_here)
        : surface(surface_here), technique(light), both(light, surface_here) {}

    double estimate(const NoiseEstimator& estimator, const Vec2<Real> (&u)[2]) const {
        if (estimator.strategies == Strategies::diffuse) return estimate_with_one(technique, surface, u);
        return estimate_with_both(both, estimator, u);
    }

    const Surface& surface;
    PolygonProjectedSolidAngle<Real, 4> technique;
    DirectLight<Real, Light> both;
};

/// \param x, y of the shading point on the plane.
Light light_seen_from(Real x, Real y) {
    const Vec3<Real> corners[] = {{-kHalfSide - x, -kHalfSide - y, 1},
                                  {-kHalfSide - x, kHalfSide - y, 1},
                                  {kHalfSide - x, kHalfSide - y, 1},
                                  {kHalfSide - x, -kHalfSide - y, 1}};
    return make_polygon<4>(corners, 4);
}

/// Mean and standard deviation of some numbers.
struct Distribution {
    double mean = 0;
    double deviation = 0;
};

Distribution distribution_at(const ShadingPoint& point, const NoiseEstimator& estimator, std::uint32_t number,
                             int samples) {
    double mean = 0;
    double squares = 0;
    for (int i = 0; i < samples; ++i) {
        const auto random = [&](std::uint32_t pair) {
            return light_random<Real>(Sampler::independent, 0, number, 0, static_cast<std::uint32_t>(i), 1, 0,
                                      pair);
        };
        const Vec2<Real> u[] = {random(0), random(1)};
        const double value = point.estimate(estimator, u);
        const double deviation = value - mean;
        mean += deviation / (i + 1);
        squares += deviation * (value - mean);
    }
    return {mean, std::sqrt(squares / (samples - 1))};
}

/// The noise of all estimators on a plane seen at one angle.
std::vector<Noise> noise_on_plane(const NoiseTable& table, const NoiseSurface& material, Real roughness,
                                  Real degrees) {
    const Real angle = degrees * (kPi<Real> / 180);
    const Vec3<Real> albedo{material.albedo, material.albedo, material.albedo};
    const Vec3<Real> f0{material.f0, material.f0, material.f0};
    const Surface surface =
        make_glossy_surface(std::cos(angle), albedo, f0, roughness, tables::frostbite_ltc_table().view());
    const NoiseEstimator quiet{"", Strategies::diffuse_ltc, Mis::weighted_balance};
    std::vector<Noise> noise(table.estimators.size());
    std::uint32_t number = 0;
    int highlighted = 0;
    for (int i = 0; i < table.points; ++i) {
        for (int j = 0; j < table.points; ++j) {
            // The mirrored direction to the eye leads from the middle of the highlight to that of the light.
            const Real x = table.extent * ((i + Real(0.5)) / table.points - Real(0.5));
            const Real y = table.extent * ((j + Real(0.5)) / table.points - Real(0.5));
            const bool in_highlight = std::max(std::fabs(x), std::fabs(y)) < kHalfSide;
            highlighted += in_highlight;
            const ShadingPoint point(light_seen_from(std::tan(angle) + x, y), surface);
            const double mean = distribution_at(point, quiet, number++, table.samples).mean;
            for (std::size_t k = 0; k < noise.size(); ++k) {
                const double relative =
                    distribution_at(point, table.estimators[k], number++, table.samples).deviation / mean;
                noise[k].on_plane += relative * relative;
                if (in_highlight) noise[k].in_highlight += relative * relative;
                noise[k].largest = std::max(noise[k].largest, relative);
            }
        }
    }
    for (Noise& n : noise) {
        n.on_plane = std::sqrt(n.on_plane) / table.points;
        n.in_highlight = std::sqrt(n.in_highlight / highlighted);
    }
    return noise;
}

/// The largest noise of all roughnesses.
double largest_noise(const NoiseTableResult& result, const NoiseLimit& limit) {
    const std::vector<double>& angles = result.table->angles;
    const auto angle = std::find(angles.begin(), angles.end(), limit.angle);
    double largest = -1;
    for (const NoiseRow& row : result.rows)
        if (angle != angles.end() && row.estimator->label == limit.estimator &&
            row.surface->name == limit.surface)
            largest =
                std::max(largest, row.noise[static_cast<std::size_t>(angle - angles.begin())].*limit.noise);
    if (largest < 0) throw std::logic_error("table " + result.table->name + " has no value for a limit");
    return largest;
}

} // namespace

const std::vector<NoiseTable>& all_noise_tables() {
    static const std::vector<NoiseTable> tables = make_noise_tables();
    return tables;
}

NoiseTable quick(NoiseTable table) {
    table.points /= 2;
    table.samples /= 4;
    return table;
}

NoiseTableResult run_noise_table(const NoiseTable& table, const RunSettings& settings,
                                 const ProgressText& progress) {
    progress(fmt::format("{} estimates at each of {} points", table.samples, table.points * table.points));
    NoiseTableResult result;
    result.table = &table;
    for (const NoiseSurface& surface : table.surfaces)
        for (const NoiseEstimator& estimator : table.estimators)
            for (const double roughness : table.roughnesses)
                result.rows.push_back(
                    {&surface, &estimator, roughness, std::vector<Noise>(table.angles.size())});

    const std::size_t estimators = table.estimators.size();
    const std::size_t roughnesses = table.roughnesses.size();
    const std::size_t angles = table.angles.size();
    const auto measure = [&](std::size_t task) {
        const std::size_t s = task / (roughnesses * angles);
        const std::size_t r = task / angles % roughnesses;
        const std::size_t a = task % angles;
        const std::vector<Noise> noise =
            noise_on_plane(table, table.surfaces[s], table.roughnesses[r], table.angles[a]);
        for (std::size_t e = 0; e < estimators; ++e)
            result.rows[(s * estimators + e) * roughnesses + r].noise[a] = noise[e];
    };
    tbb::task_arena(thread_count(settings)).execute([&] {
        tbb::parallel_for(std::size_t{0}, table.surfaces.size() * roughnesses * angles, measure);
    });
    for (const NoiseLimit& limit : table.limits) {
        const double noise = largest_noise(result, limit);
        result.expectations.push_back(checked(
            fmt::format("{}, {} at {:g} degrees {}: {:.2f} %, at most {:g} %", limit.estimator, limit.surface,
                        limit.angle, limit.noise == &Noise::on_plane ? "on the plane" : "in the highlight",
                        100 * noise, 100 * limit.limit),
            noise <= limit.limit));
    }
    return result;
}

} // namespace nusselt::lab
