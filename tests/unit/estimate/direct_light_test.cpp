/// Tests of direct light: no noise where the lobes fit the BRDF, hostile lights and surfaces, packs, and precision.
/// tests/statistics/direct_light_test.cpp tests the means.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/adaptive_quadrature.h"
#include "ltc/reference.h"
#include "reflecting.h"

namespace nusselt_test {
namespace {

using nusselt::DirectLight;
using nusselt::DirectLightSample;
using nusselt::GlossySurface;
using nusselt::Lambert;
using nusselt::Ltc;
using nusselt::Vec2;
using nusselt::Vec3;
using nusselt::WeightedBalanceHeuristic;
using Colour = Vec3<double>;
using Optimal = nusselt::OptimalHeuristic<double>;
using Direct = nusselt::ProjectedSolidAngleAndLtc;
using Biased = nusselt::BiasedProjectedSolidAngleAndLtc;
using ByBrdf = nusselt::SolidAngleAndBrdf<nusselt::GgxVisibleNormals>;

/// These avoid the ends of lights and the horizon, where densities may be 0.
const std::vector<Vec2<double>> kRandomNumbers = {{0.001, 0.002}, {0.1, 0.7},  {0.3, 0.2},
                                                  {0.5, 0.9},     {0.75, 0.4}, {0.999, 0.1}};

void expect_colour(const Colour& actual, const Colour& expected, const std::string& name) {
    EXPECT_NEAR(actual.x, expected.x, 1e-11 * (1 + expected.x)) << name;
    EXPECT_NEAR(actual.y, expected.y, 1e-11 * (1 + expected.y)) << name;
    EXPECT_NEAR(actual.z, expected.z, 1e-11 * (1 + expected.z)) << name;
}

/// A BRDF whose components times the cosine are proportional to the densities of the techniques.
struct FittingBrdf {
    Colour albedo, specular;
    Ltc<double> lobe;

    nusselt::BrdfComponents<double> eval_components(const Vec3<double>& wi) const {
        if (!(wi.z > 0)) return {};
        return {1 / nusselt::kPi<double> * albedo, lobe.density(wi) / wi.z * specular};
    }
};

const Colour kAlbedo{0.5, 0.25, 0}, kSpecular{0.1, 0.7, 0.9};

GlossySurface<double, FittingBrdf> fitting_surface(const nusselt::LtcCoefficients<double>& lobe) {
    const Ltc<double> ltc(lobe);
    // The coefficients assume a smallest albedo for the channel without any, so they do not fit and this channel is
    // noisy.
    return {{0, 0, 1}, 1, {kAlbedo, kSpecular, ltc}, ltc, kAlbedo, kSpecular};
}

/// \param diffuse, specular integrals of both components over a light, for albedos of 1.
template <class Light, class Surface>
void expect_no_noise(const Light& light, const Surface& surface, long double diffuse, long double specular,
                     const std::string& name) {
    const DirectLight<double, Light, FittingBrdf> estimator(light, surface, 1, 2);
    const Colour expected =
        static_cast<double>(diffuse) * kAlbedo + static_cast<double>(specular) * kSpecular;
    const auto check = [&](const auto& heuristic) {
        for (const Vec2<double>& u : kRandomNumbers) {
            const auto a = estimator.sample_diffuse(heuristic, u);
            const auto b = estimator.sample_specular(heuristic, {u.y, u.x});
            const auto c = estimator.sample_specular(heuristic, {u.y, 0.5 * u.x});
            Colour sum{0, 0, 0};
            for (const auto& s : {a, b, c}) sum = sum + s.shadowed + s.constant;
            sum.z = expected.z;
            expect_colour(sum, expected, name);
        }
    };
    check(WeightedBalanceHeuristic());
    check(nusselt::ClampedOptimalHeuristic<double>{1});
    check(Optimal{1});
}

TEST(DirectLight, NoNoiseWhereLobesFit) {
    for (const LobeCase& lobe : lobe_cases()) {
        const ReferenceLobe reference(lobe.coefficients);
        const auto surface = fitting_surface(lobe.coefficients);
        for (const PolygonCase& light : polygon_cases()) {
            const Polygon polygon = vertices_of(make_light<double>(light));
            // Samples below the surface would add noise.
            if (std::any_of(polygon.begin(), polygon.end(), [](const Point& v) { return v.z < 0; })) continue;
            expect_no_noise(make_light<double>(light), surface, lambert(polygon) / kPi,
                            reference.integral(cut(polygon, reference.horizon())), light.name);
        }
        for (const LineCase& light : line_cases()) {
            const auto line = make_light<double>(light);
            if (light.begin.z < 0 || light.end.z < 0) continue;
            const Segment segment{widened_begin(line), widened_end(line)};
            const auto density = [&](const Point& wi) { return reference.density(wi); };
            expect_no_noise(line, surface,
                            integrate_per_radius(segment, [](const Point& wi) { return wi.z / kPi; }),
                            integrate_per_radius(cut(segment, reference.horizon()), density), light.name);
        }
    }
}

TEST(DirectLight, LambertianSurfacesNeedOneTechnique) {
    const Lambert<double> brdf{{0.5, 0.25, 0.125}};
    const GlossySurface<double, Lambert<double>> surface{
        {0, 0, 1}, 1, brdf, Ltc<double>(lobe_cases()[0].coefficients), brdf.albedo, {0, 0, 0}};
    for (const PolygonCase& light : polygon_cases()) {
        const auto polygon = make_light<double>(light);
        const DirectLight<double, std::decay_t<decltype(polygon)>, Lambert<double>> estimator(polygon,
                                                                                              surface);
        EXPECT_FALSE(surface.is_glossy());
        const auto share = static_cast<double>(lambert(above_horizon(vertices_of(polygon))) / kPi);
        for (const Vec2<double>& u : kRandomNumbers) {
            const auto check = [&](const auto& heuristic) {
                const auto diffuse = estimator.sample_diffuse(heuristic, u);
                expect_colour(diffuse.shadowed + diffuse.constant, share * brdf.albedo, light.name);
                const auto specular = estimator.sample_specular(heuristic, u);
                expect_colour(specular.shadowed + specular.constant, {0, 0, 0}, light.name);
            };
            check(nusselt::BalanceHeuristic());
            check(nusselt::PowerHeuristic());
            check(WeightedBalanceHeuristic());
            check(Optimal{0.5});
            check(nusselt::SeparateComponents());
            expect_colour(estimator.sample_one(u).shadowed, share * brdf.albedo, light.name);
        }
    }
}

bool is_finite_and_not_negative(const Vec3<float>& c) {
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && c.x >= 0 && c.y >= 0 && c.z >= 0;
}

template <class Case, class Strategies>
void expect_no_surprises(std::uint64_t seed, int count) {
    HostileReflections<float> reflections(seed);
    int lit = 0;
    for (int i = 0; i < count; ++i) {
        const auto c = reflections.next<Case>();
        const auto all = all_samples<Strategies>(c);
        for (int k = 0; k < all.kCount; ++k) {
            const auto& s = all.sample[k];
            ASSERT_TRUE(nusselt::hostile::all_finite(s.wi)) << k << ": " << hexadecimal<float>(c);
            ASSERT_TRUE(is_finite_and_not_negative(s.shadowed))
                << k << ": " << hexadecimal<float>(c) << s.shadowed.x;
            if (all.is_optimal(k))
                ASSERT_TRUE(nusselt::hostile::all_finite(s.constant)) << k << ": " << hexadecimal<float>(c);
            else
                ASSERT_TRUE(s.constant.x == 0 && s.constant.y == 0 && s.constant.z == 0) << k;
            lit += s.shadowed.x > 0;
        }
    }
    // The test would be worthless if most samples were black.
    EXPECT_GT(lit, count);
}

TEST(DirectLightHostile, PolygonsAreFinite) {
    expect_no_surprises<PolygonReflection<float>, Direct>(31, 100'000);
}
TEST(DirectLightHostile, LinesAreFinite) { expect_no_surprises<LineReflection<float>, Direct>(32, 100'000); }
TEST(DirectLightHostile, CylindersAreFinite) {
    expect_no_surprises<CylinderReflection<float>, Direct>(34, 100'000);
}
TEST(DirectLightHostile, BiasedSamplesAreFinite) {
    expect_no_surprises<PolygonReflection<float>, Biased>(35, 100'000);
}
TEST(DirectLightHostile, SamplesOfTheBrdfAreFinite) {
    expect_no_surprises<PolygonReflection<float>, ByBrdf>(33, 100'000);
}

/// A case whose light has a moderate size and distance.
template <class T, class Case>
Case ordinary(HostileReflections<T>& reflections, int i) {
    const auto lights = [] {
        if constexpr (std::is_same_v<Case, PolygonReflection<T>>) {
            return polygon_cases();
        } else if constexpr (std::is_same_v<Case, CylinderReflection<T>>) {
            return cylinder_cases();
        } else {
            return line_cases();
        }
    }();
    Case c;
    c.light = make_light<T>(lights[static_cast<std::size_t>(i) % lights.size()]);
    reflections.fill(c);
    return c;
}

/// The samples of a case as those of scalars or, where scalar code takes the vertices of a light as lanes and has other bits, as
/// those of packs with the case in all lanes.
template <class Strategies, class P, template <class> class Case>
auto samples_alone(const Case<nusselt::scalar_t<P>>& c) {
    using T = nusselt::scalar_t<P>;
    auto expected = all_samples<Strategies>(c);
    if constexpr (std::is_same_v<Case<float>, PolygonReflection<T>> && NUSSELT_HAS_VERTEX_LANES) {
        Case<P> lanes;
        for (int i = 0; i < nusselt::RealTraits<P>::kLanes; ++i) set_lane<T>(lanes, i, c);
        const auto packed = all_samples<Strategies>(lanes);
        for (int k = 0; k < expected.kCount; ++k)
            expected.sample[k] = get_lane<T, DirectLightSample<T>>(packed.sample[k], 0);
    }
    return expected;
}

/// One lane at a time holds a case while its neighbours hold NaN.
template <class Strategies, template <class> class Case, class P>
void expect_lanes_equal_scalars() {
    using T = nusselt::scalar_t<P>;
    constexpr int kLanes = nusselt::RealTraits<P>::kLanes;
    HostileReflections<T> reflections(41);
    for (int i = 0; i < 4000; ++i) {
        const auto c = ordinary<T, Case<T>>(reflections, i);
        const int lane = i % kLanes;
        Case<P> lanes;
        std::memset(static_cast<void*>(&lanes), 0xff, sizeof lanes); // quiet NaN in every number
        set_lane<T>(lanes, lane, c);
        const auto expected = samples_alone<Strategies, P, Case>(c);
        const auto packed = all_samples<Strategies>(lanes);
        for (int k = 0; k < expected.kCount; ++k) {
            const auto s = get_lane<T, DirectLightSample<T>>(packed.sample[k], lane);
            const auto& e = expected.sample[k];
            const auto same = [](const Vec3<T>& a, const Vec3<T>& b) {
                return a.x == b.x && a.y == b.y && a.z == b.z;
            };
            ASSERT_TRUE(same(s.shadowed, e.shadowed) && same(s.constant, e.constant))
                << k << ": " << hexadecimal<T>(c);
            const bool same_place = same(s.wi, e.wi) && same(s.p, e.p);
            ASSERT_TRUE(same_place || !(e.shadowed.x > 0)) << k << ": " << hexadecimal<T>(c);
        }
    }
}

TEST(DirectLightPacks, LanesEqualScalars) {
    expect_lanes_equal_scalars<Direct, PolygonReflection, NativeFloat>();
    expect_lanes_equal_scalars<Direct, PolygonReflection, NativeDouble>();
    expect_lanes_equal_scalars<Direct, LineReflection, NativeFloat>();
    expect_lanes_equal_scalars<Direct, CylinderReflection, NativeFloat>();
    expect_lanes_equal_scalars<Direct, CylinderReflection, NativeDouble>();
    expect_lanes_equal_scalars<Biased, PolygonReflection, NativeFloat>();
    expect_lanes_equal_scalars<ByBrdf, PolygonReflection, NativeFloat>();
}

/// Means over a grid of random numbers. Single samples would not do: they jump where the horizon of a lobe cuts the
/// light.
template <class T, class Light>
std::vector<double> means(Reflection<T, Light> c) {
    constexpr int kGrid = 24;
    std::vector<double> sums(AllSamples<T>::kCount);
    for (int i = 0; i < kGrid * kGrid; ++i) {
        const T x = (static_cast<T>(i % kGrid) + T(0.5)) / kGrid;
        const T y = (static_cast<T>(i / kGrid) + T(0.5)) / kGrid;
        c.u[0] = c.u[1] = {x, y};
        const auto all = all_samples<Direct>(c);
        for (std::size_t k = 0; k < sums.size(); ++k)
            sums[k] +=
                static_cast<double>((all.sample[k].shadowed + all.sample[k].constant).y) / (kGrid * kGrid);
    }
    return sums;
}

template <class T, class Case, class Light>
Reflection<T, Light> reflection_in(const Case& light, const LobeCase& lobe, T roughness) {
    return {make_light<T>(light),
            rounded<T>(lobe.coefficients),
            {T(0.6L), 0, T(0.8L)},
            {T(0.5L), T(0.25L), 0},
            {T(0.04L), T(0.5L), 1},
            roughness,
            {}};
}

template <template <class> class LightOf, class Cases>
void expect_precise(const Cases& cases) {
    for (const auto& light : cases) {
        for (const LobeCase& lobe : lobe_cases()) {
            const auto single =
                means(reflection_in<float, decltype(light), LightOf<float>>(light, lobe, 0.4f));
            const auto exact =
                means(reflection_in<double, decltype(light), LightOf<double>>(light, lobe, 0.4f));
            for (std::size_t k = 0; k < exact.size(); ++k)
                EXPECT_NEAR(single[k], exact[k], 1e-5 * (0.1 + exact[k])) << light.name << ", " << k;
        }
    }
}

template <class T>
using Quadrilateral = nusselt::ConvexPolygon<T, 4>;

TEST(DirectLightPrecision, FloatIsCloseToDouble) {
    expect_precise<Quadrilateral>(polygon_cases());
    expect_precise<nusselt::LineSegment>(line_cases());
    expect_precise<nusselt::Cylinder>(cylinder_cases());
}

} // namespace
} // namespace nusselt_test
