#include "lab/statements/measurements.h"
#include "tables/ltc_table.h"

#include <nusselt/estimate/mis.h>
#include <nusselt/estimate/strategies.h>
#include <nusselt/random/pcg.h>
#include <nusselt/random/unit_interval.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace nusselt::lab {

namespace {

using Direction = Vec3<double>;
using Polygon = ConvexPolygon<double, 4>;
using Line = LineSegment<double>;
using Surface = GlossySurface<double>;

constexpr double kRoughnesses[] = {0.2, 0.4, 0.6};
constexpr double kAngles[] = {0, 40, 75, 85}; ///< of the eye from the normal [degrees]

/// A square of side 1 m at a height of 1 m.
/// \param x, y of the shading point.
Polygon square_seen_from(double x, double y) {
    const Direction corners[] = {
        {-0.5 - x, -0.5 - y, 1}, {-0.5 - x, 0.5 - y, 1}, {0.5 - x, 0.5 - y, 1}, {0.5 - x, -0.5 - y, 1}};
    return make_polygon<4>(corners, 4);
}

/// A line of 2 m at the same height, askew.
Line line_seen_from(double x, double y) {
    return make_line(Direction{-0.8 - x, -0.6 - y, 1}, Direction{0.8 - x, 0.6 - y, 1});
}

/// Both techniques for a light and a surface, and samples of them.
template <class Light>
class Pair {
public:
    Pair(const Light& light, const Surface& surface)
        : diffuse_(ProjectedSolidAngleAndLtc::diffuse(light, surface)),
          specular_(ProjectedSolidAngleAndLtc::specular(light, surface)) {}

    /// With albedos to form coefficients with.
    MisTechniques<double, 2> techniques(double diffuse_albedo, double specular_albedo) const {
        const auto grey = [](double x) { return Direction{x, x, x}; };
        return {{1, 1},
                {grey(diffuse_albedo * ProjectedSolidAngleAndLtc::diffuse_integral(diffuse_)),
                 grey(specular_albedo * ProjectedSolidAngleAndLtc::specular_integral(specular_))}};
    }

    /// A sample of technique J.
    /// \param components the BRDF times cosine in a direction: both of them, grey.
    template <int J, class Components>
    MisSample<double, 2> sample(const Vec2<double>& u, const Components& components) const {
        const LightSample<double> s = J == 0 ? draw(diffuse_, u) : draw(specular_, u);
        if (!(s.pdf > 0)) return {{0, 0}, {{0, 0, 0}, {0, 0, 0}}};
        const auto [diffuse, specular] = components(s.wi);
        return {{diffuse_.pdf(s.wi), specular_.pdf(s.wi)},
                {{diffuse, diffuse, diffuse}, {specular, specular, specular}}};
    }

private:
    decltype(ProjectedSolidAngleAndLtc::diffuse(std::declval<Light>(), std::declval<Surface>())) diffuse_;
    decltype(ProjectedSolidAngleAndLtc::specular(std::declval<Light>(), std::declval<Surface>())) specular_;
};

class Estimates {
public:
    void add(double value) {
        ++count_;
        const double deviation = value - mean_;
        mean_ += deviation / count_;
        squares_ += deviation * (value - mean_);
        largest_ = std::max(largest_, value);
    }
    double relative_variance() const { return squares_ / (count_ - 1) / (mean_ * mean_); }
    double largest_over_mean() const { return largest_ / mean_; }

private:
    int count_ = 0;
    double mean_ = 0, squares_ = 0, largest_ = 0;
};

/// Takes a sample of each technique many times.
/// \param visit called with both samples.
template <class Light, class Components, class Visit>
void for_each_sample(const Pair<Light>& pair, const Components& components, int count, Pcg32& random,
                     const Visit& visit) {
    const auto next = [&] {
        const double x = to_unit<double>(random());
        return Vec2<double>{x, to_unit<double>(random())};
    };
    for (int i = 0; i < count; ++i) {
        const auto of_diffuse = pair.template sample<0>(next(), components);
        const auto of_specular = pair.template sample<1>(next(), components);
        visit(of_diffuse, of_specular);
    }
}

template <class Heuristic>
double estimate(const Heuristic& heuristic, const MisTechniques<double, 2>& techniques,
                const MisSample<double, 2>& a, const MisSample<double, 2>& b) {
    return heuristic.template estimate<0>(techniques, a).shadowed.x +
           heuristic.template estimate<1>(techniques, b).shadowed.x;
}

/// Calls visit(surface, x, y) for surfaces of all roughnesses and angles, and for shading points around the highlight and far
/// from it, where fitted lobes vanish and BRDFs do not.
template <class Visit>
void for_each_place(double albedo, double f0, const Visit& visit) {
    constexpr int kPoints = 6;
    constexpr double kExtent = 12; // of the square of shading points [m]
    for (const double roughness : kRoughnesses)
        for (const double degrees : kAngles) {
            const double angle = degrees * (kPi<double> / 180);
            const Surface surface =
                make_glossy_surface(std::cos(angle), Direction{albedo, albedo, albedo}, Direction{f0, f0, f0},
                                    roughness, tables::frostbite_ltc_table().view());
            for (int i = 0; i < kPoints; ++i)
                for (int j = 0; j < kPoints; ++j)
                    visit(surface, std::tan(angle) + kExtent * ((i + 0.5) / kPoints - 0.5),
                          kExtent * ((j + 0.5) / kPoints - 0.5));
        }
}

/// Largest relative variances of an estimate from two samples where the BRDF is a sum of a Lambertian lobe and an LTC.
struct ExactLobes {
    double weighted_balance = 0, balance = 0;
    int places = 0;
};

template <class Light, class SeenFrom>
ExactLobes with_exact_lobes(const SeenFrom& seen_from, int samples) {
    constexpr double kDiffuse = 0.5, kSpecular = 0.3;
    ExactLobes largest;
    Pcg32 random(1);
    for_each_place(kDiffuse, 0.04, [&](const Surface& surface, double x, double y) {
        const Pair<Light> pair(seen_from(x, y), surface);
        const MisTechniques<double, 2> techniques = pair.techniques(kDiffuse, kSpecular);
        const auto components = [&](const Direction& wi) {
            return std::pair(kDiffuse * wi.z / kPi<double>, kSpecular * surface.lobe.density(wi));
        };
        Estimates weighted, balanced;
        for_each_sample(pair, components, samples, random, [&](const auto& a, const auto& b) {
            weighted.add(estimate(WeightedBalanceHeuristic(), techniques, a, b));
            balanced.add(estimate(BalanceHeuristic(), techniques, a, b));
        });
        largest.weighted_balance = std::max(largest.weighted_balance, weighted.relative_variance());
        largest.balance = std::max(largest.balance, balanced.relative_variance());
        ++largest.places;
    });
    return largest;
}

constexpr double kBounds[] = {1e-6, 1e-4, 1e-3, kSmallestDiffuseAlbedo, 0.1, 1};
constexpr std::size_t kBoundCount = std::size(kBounds);
constexpr std::size_t kPublished = 3; ///< the bound of the papers

/// Noise under the weighted balance heuristic on a surface without a diffuse component.
struct SmallestAlbedos {
    double noise[kBoundCount] = {}; ///< root mean square over places, relative to the mean
    double worst[kBoundCount] = {}; ///< largest estimate over the mean
};

template <class Light, class SeenFrom>
SmallestAlbedos with_smallest_albedos(const SeenFrom& seen_from, double f0, int samples) {
    SmallestAlbedos result;
    Pcg32 random(2);
    int places = 0;
    for_each_place(0, f0, [&](const Surface& surface, double x, double y) {
        const Pair<Light> pair(seen_from(x, y), surface);
        const auto components = [&](const Direction& wi) {
            return std::pair(0.0, wi.z > 0 ? wi.z * surface.brdf.eval_specular(wi).x : 0.0);
        };
        Estimates estimates[kBoundCount];
        for_each_sample(pair, components, samples, random, [&](const auto& a, const auto& b) {
            for (std::size_t i = 0; i < kBoundCount; ++i)
                estimates[i].add(estimate(WeightedBalanceHeuristic(),
                                          pair.techniques(kBounds[i], surface.specular_albedo.x), a, b));
        });
        ++places;
        for (std::size_t i = 0; i < kBoundCount; ++i) {
            result.noise[i] += estimates[i].relative_variance();
            result.worst[i] = std::max(result.worst[i], estimates[i].largest_over_mean());
        }
    });
    for (double& noise : result.noise) noise = std::sqrt(noise / places);
    return result;
}

void append_smallest_albedos(const char* item, const std::string& light, const SmallestAlbedos& result,
                             Findings& findings, Table& table) {
    table.push_back({light});
    for (std::size_t i = 0; i < kBoundCount; ++i)
        table.back().push_back(fmt::format("{:.1f} % / {:.1f}", 100 * result.noise[i], result.worst[i]));
    const double least = *std::min_element(std::begin(result.noise), std::end(result.noise));
    findings.all.push_back(at_most(item,
                                   fmt::format("noise with a bound of {:g} over the least of all bounds, {}",
                                               kSmallestDiffuseAlbedo, light),
                                   result.noise[kPublished] / least, 1.25));
    findings.all.push_back(at_most(item,
                                   fmt::format("largest estimate over the mean with that bound, {}", light),
                                   result.worst[kPublished], 15));
}

/// With a small bound, samples count far too much where the lobe is much smaller than the BRDF. Metals show it best.
void append_fireflies(const char* item, const std::string& light, const SmallestAlbedos& result,
                      Findings& findings) {
    findings.all.push_back(at_least(item,
                                    fmt::format("noise with a bound of {:g} over that with {:g}, {}",
                                                kBounds[0], kBounds[kPublished], light),
                                    result.noise[0] / result.noise[kPublished], 1.3));
}

} // namespace

Findings measure_heuristics(Effort effort) {
    const int samples = effort == Effort::quick ? 500 : 8000;
    const char* const kNoVariance = "polygons-sec-4.2-no-variance";
    const ExactLobes polygons = with_exact_lobes<Polygon>(square_seen_from, samples);
    const ExactLobes lines = with_exact_lobes<Line>(line_seen_from, samples);
    Finding ideal =
        at_most(kNoVariance,
                fmt::format("largest variance over squared mean, weighted balance, {} places under "
                            "a polygon",
                            polygons.places),
                polygons.weighted_balance, 1e-20);
    ideal.published = "variance in the ideal case";
    Findings findings = {{ideal, at_most(kNoVariance, "the same under a line", lines.weighted_balance, 1e-20),
                          at_least(kNoVariance, "balance heuristic, under a polygon", polygons.balance, 0.01),
                          at_least(kNoVariance, "balance heuristic, under a line", lines.balance, 0.01)}};

    Table table = {{"black diffuse component: noise / largest estimate over mean"}};
    for (const double bound : kBounds) table[0].push_back(fmt::format("bound {:g}", bound));
    const char* const kPolygons = "polygons-sec-4.2-smallest-albedo";
    const char* const kLines = "lines-sec-4.2-smallest-albedo";
    for (const double f0 : {0.04, 0.9}) {
        const std::string polygon = fmt::format("polygon, f0 {:g}", f0);
        const std::string line = fmt::format("line, f0 {:g}", f0);
        const auto of_polygon = with_smallest_albedos<Polygon>(square_seen_from, f0, samples);
        const auto of_line = with_smallest_albedos<Line>(line_seen_from, f0, samples);
        append_smallest_albedos(kPolygons, polygon, of_polygon, findings, table);
        append_smallest_albedos(kLines, line, of_line, findings, table);
        if (f0 < 0.5) continue;
        append_fireflies(kPolygons, polygon, of_polygon, findings);
        append_fireflies(kLines, line, of_line, findings);
    }
    findings.tables.push_back(std::move(table));
    return findings;
}

} // namespace nusselt::lab
