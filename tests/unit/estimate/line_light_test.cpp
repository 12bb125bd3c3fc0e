/// Tests of the light that surfaces reflect from lines: integrals against quadrature, no noise where the lobes fit
/// the BRDF, hostile lights, packs, and offsets sampled by reflected light. tests/statistics/line_light_test.cpp
/// tests the means.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/estimate/reflected_offsets.h>

#include "geometry/adaptive_quadrature.h"
#include "ltc/reference.h"
#include "reflecting.h"

namespace nusselt_test {
namespace {

using nusselt::BrdfComponents;
using nusselt::GlossySurface;
using nusselt::Interval;
using nusselt::LineFamily;
using nusselt::LineLight;
using nusselt::LinePlane;
using nusselt::Ltc;
using nusselt::ReflectedOffsets;
using nusselt::Vec3;
using nusselt::VisibleParts;
using Colour = Vec3<double>;

constexpr int kCapacity = 8;

/// A line of a light without its hidden parts. These are given by their ends, as shares of the length of the line.
template <class Real>
struct CutLine {
    CutLine(const Interval<Real>& whole, const std::vector<Interval<Real>>& hidden)
        : parts(storage, kCapacity) {
        parts.reset(whole);
        const Real length = whole.end - whole.begin;
        for (const auto& h : hidden)
            parts.cut({whole.begin + h.begin * length, whole.begin + h.end * length});
    }
    CutLine(const CutLine&) = delete;
    CutLine& operator=(const CutLine&) = delete;

    Interval<Real> storage[kCapacity];
    VisibleParts<Real> parts;
};

const std::vector<std::vector<Interval<double>>> kShadows = {
    {}, {{0.2, 0.5}}, {{0.3, 0.35}, {0.7, 0.72}, {0.9, 1.1}}, {{-1, 2}}};

/// A BRDF whose components times the cosine equal the integrands of the closed forms.
struct FittingBrdf {
    Colour albedo, specular;
    Ltc<double> lobe;

    BrdfComponents<double> eval_components(const Vec3<double>& wi) const {
        if (!(wi.z > 0)) return {};
        return {1 / nusselt::kPi<double> * albedo, lobe.density(wi) / wi.z * specular};
    }
};

const Colour kAlbedo{0.5, 0.25, 0}, kSpecular{0.1, 0.7, 0.9};

GlossySurface<double, FittingBrdf> fitting_surface(const nusselt::LtcCoefficients<double>& lobe) {
    const Ltc<double> ltc(lobe);
    return {{0, 0, 1}, 1, {kAlbedo, kSpecular, ltc}, ltc, kAlbedo, kSpecular};
}

/// The reflected light of the visible parts of a line by quadrature, for a radiance of 1 and per metre of offset.
/// \param horizon normal of the plane that bounds the lobe.
template <class Lobe>
long double integral_of(const LinePlane<double>& plane, double offset, const VisibleParts<double>& parts,
                        const Point& horizon, const Lobe& lobe) {
    long double sum = 0;
    for (int k = 0; k < parts.count(); ++k) {
        if (!(parts[k].begin < parts[k].end)) continue;
        const auto at = [&](double t) {
            return nusselt::broadcast<long double>(plane.origin) +
                   static_cast<long double>(offset) * nusselt::broadcast<long double>(plane.across) +
                   static_cast<long double>(t) * nusselt::broadcast<long double>(plane.along);
        };
        Segment segment{at(parts[k].begin), at(parts[k].end)};
        for (const Point& up : {Point{0, 0, 1}, horizon}) {
            if (dot(up, segment.begin) <= 0 && dot(up, segment.end) <= 0) segment.end = segment.begin;
            segment = cut(segment, up);
        }
        if (!(length(segment.end - segment.begin) > 0)) continue;
        const Point s = normalize(segment.end - segment.begin);
        const Point closest = segment.begin - dot(segment.begin, s) * s;
        const long double facing =
            std::fabs(dot(closest, nusselt::broadcast<long double>(plane.normal))) / length(closest);
        sum += facing / 2 * integrate_per_radius(segment, lobe);
    }
    return sum;
}

TEST(LineLight, AnalyticIsTheIntegral) {
    int lit = 0;
    for (const LobeCase& lobe : lobe_cases()) {
        const ReferenceLobe reference(lobe.coefficients);
        const auto surface = fitting_surface(lobe.coefficients);
        for (const PolygonCase& c : polygon_cases()) {
            const auto light = make_light<double>(c);
            for (const double angle : {0.0, 0.7, 2.4}) {
                const LineFamily<double, 4> family(light, angle);
                const LineLight<double, FittingBrdf> estimator(family.plane(), family.reach(), surface);
                for (std::size_t i = 0; i < kShadows.size(); ++i) {
                    const double offset = family.sample_by_length((static_cast<double>(i) + 0.4) / 4).offset;
                    const CutLine<double> line(family.chord(offset).extent, kShadows[i]);
                    const auto actual = estimator.analytic(offset, line.parts);
                    const auto diffuse =
                        static_cast<double>(integral_of(family.plane(), offset, line.parts, {0, 0, 1},
                                                        [](const Point& wi) { return wi.z / kPi; }));
                    const auto specular = static_cast<double>(
                        integral_of(family.plane(), offset, line.parts, reference.horizon(),
                                    [&](const Point& wi) { return reference.density(wi); }));
                    const auto expect_share = [&](const Colour& value, double share, const Colour& albedo) {
                        EXPECT_NEAR(value.x, share * albedo.x, 1e-9 * share * albedo.x) << c.name;
                        EXPECT_NEAR(value.y, share * albedo.y, 1e-9 * share * albedo.y) << c.name;
                        EXPECT_NEAR(value.z, share * albedo.z, 1e-9 * share * albedo.z) << c.name;
                    };
                    expect_share(actual.diffuse, diffuse, kAlbedo);
                    expect_share(actual.specular, specular, kSpecular);
                    lit += specular > 0;
                }
            }
        }
    }
    EXPECT_GT(lit, 50);
}

TEST(LineLight, NoNoiseWhereLobesFit) {
    for (const LobeCase& lobe : lobe_cases()) {
        const auto surface = fitting_surface(lobe.coefficients);
        for (const PolygonCase& c : polygon_cases()) {
            const auto light = make_light<double>(c);
            const LineFamily<double, 4> family(light, 0.7);
            const LineLight<double, FittingBrdf> estimator(family.plane(), family.reach(), surface);
            for (const auto& shadows : kShadows) {
                const double offset = family.sample_by_length(0.3).offset;
                const CutLine<double> line(family.chord(offset).extent, shadows);
                const auto expected = estimator.analytic(offset, line.parts);
                // The random numbers avoid the ends of parts, which may be on the horizon, where BRDFs end.
                for (const double u : {0.001, 0.1, 0.4, 0.7, 0.999}) {
                    const auto actual = estimator.unbiased(offset, line.parts, u);
                    EXPECT_NEAR(actual.diffuse.x, expected.diffuse.x, 1e-12 * expected.diffuse.x) << c.name;
                    EXPECT_NEAR(actual.specular.y, expected.specular.y, 1e-11 * expected.specular.y)
                        << c.name;
                }
            }
        }
    }
}

TEST(LineLight, LambertianSurfacesNeedNoPoint) {
    const nusselt::Lambert<double> brdf{{0.5, 0.25, 0.125}};
    const GlossySurface<double, nusselt::Lambert<double>> surface{
        {0, 0, 1}, 1, brdf, Ltc<double>(lobe_cases()[0].coefficients), brdf.albedo, {0, 0, 0}};
    const auto light = make_light<double>(polygon_cases()[0]);
    const LineFamily<double, 4> family(light, 0.7);
    const LineLight<double, nusselt::Lambert<double>> estimator(family.plane(), family.reach(), surface);
    // The mean over offsets is the closed form for polygons.
    constexpr int kLines = 20'000;
    Colour sum{0, 0, 0};
    for (int i = 0; i < kLines; ++i) {
        const auto choice = family.sample_by_length((i + 0.5) / kLines);
        const CutLine<double> line(family.chord(choice.offset).extent, {});
        const auto light_of_line = estimator.unbiased(choice.offset, line.parts, 0.5);
        EXPECT_EQ(light_of_line.specular.x, 0);
        sum = sum + (1 / choice.pdf) * light_of_line.diffuse;
    }
    const auto share = static_cast<double>(lambert(above_horizon(vertices_of(light))) / kPi);
    EXPECT_NEAR(sum.x / kLines, share * brdf.albedo.x, 1e-6 * share);
    EXPECT_NEAR(sum.z / kLines, share * brdf.albedo.z, 1e-6 * share);
}

TEST(LineLight, HiddenLinesAreBlack) {
    const auto surface = fitting_surface(lobe_cases()[0].coefficients);
    const auto light = make_light<double>(polygon_cases()[0]);
    const LineFamily<double, 4> family(light, 0);
    const LineLight<double, FittingBrdf> estimator(family.plane(), family.reach(), surface);
    const double offset = family.sample_by_length(0.3).offset;
    const CutLine<double> line(family.chord(offset).extent, {{-1, 2}});
    const auto reflected = estimator.unbiased(offset, line.parts, 0.5);
    EXPECT_EQ(reflected.diffuse.x, 0);
    EXPECT_EQ(reflected.specular.y, 0);
}

/// Everything that the reflected light of a line depends on.
template <class Real>
struct LineCaseOf {
    PolygonReflection<Real> reflection;
    LinePlane<Real> plane;
    Real reach;
    Real offset;
    Interval<Real> whole, hidden;
};

template <class T>
class HostileLines {
public:
    explicit HostileLines(std::uint64_t seed) : reflections_(seed), random_(seed + 7) {}

    LineCaseOf<T> next() { return on(reflections_.template next<PolygonReflection<T>>()); }

    /// A line on a light of moderate size.
    LineCaseOf<T> next_ordinary(int i) {
        const auto cases = polygon_cases();
        PolygonReflection<T> reflection;
        reflections_.fill(reflection);
        reflection.light = make_light<T>(cases[static_cast<std::size_t>(i) % cases.size()]);
        return on(reflection);
    }

private:
    LineCaseOf<T> on(const PolygonReflection<T>& reflection) {
        LineCaseOf<T> c;
        c.reflection = reflection;
        const LineFamily<T, 4> family(c.reflection.light, static_cast<T>(random_.between(0, 3.14)));
        c.plane = family.plane();
        c.reach = family.reach();
        c.offset = family.sample_by_length(c.reflection.u[0].x).offset;
        c.whole = family.chord(c.offset).extent;
        const T length = c.whole.end - c.whole.begin;
        const auto begin = static_cast<T>(random_.between(-0.5, 1));
        c.hidden = {c.whole.begin + begin * length,
                    c.whole.begin + (begin + static_cast<T>(random_.uniform())) * length};
        return c;
    }

    HostileReflections<T> reflections_;
    RandomSource random_;
};

/// Analytic shading of the whole line and of its visible parts, and the unbiased estimate of the visible parts.
template <class Real>
struct LineResults {
    BrdfComponents<Real> whole, analytic, unbiased;
};

template <class Real>
LineResults<Real> results_of(const LineCaseOf<Real>& c) {
    const auto surface = c.reflection.surface();
    const LineLight<Real> estimator(c.plane, c.reach, surface);
    Interval<Real> storage[2];
    VisibleParts<Real> parts(storage, 2);
    parts.reset(c.whole);
    LineResults<Real> results;
    results.whole = estimator.analytic(c.offset, parts);
    parts.cut(c.hidden);
    results.analytic = estimator.analytic(c.offset, parts);
    results.unbiased = estimator.unbiased(c.offset, parts, c.reflection.u[1].x);
    return results;
}

TEST(LineLight, HostileLinesAreFiniteAndNeverBrighterThanWithoutShadow) {
    HostileLines<float> lines(51);
    int lit = 0;
    for (int i = 0; i < 200'000; ++i) {
        const auto c = lines.next();
        const auto results = results_of(c);
        for (const auto& r : {results.whole, results.analytic, results.unbiased}) {
            ASSERT_TRUE(nusselt::hostile::all_finite(r.diffuse)) << hexadecimal<float>(c);
            ASSERT_TRUE(nusselt::hostile::all_finite(r.specular)) << hexadecimal<float>(c);
        }
        const auto within = [](float part, float whole) {
            return part >= 0 && part <= whole * (1 + 1e-5f) + std::numeric_limits<float>::min();
        };
        ASSERT_TRUE(within(results.analytic.diffuse.x, results.whole.diffuse.x)) << hexadecimal<float>(c);
        ASSERT_TRUE(within(results.analytic.specular.x, results.whole.specular.x)) << hexadecimal<float>(c);
        lit += results.analytic.diffuse.x > 0;
    }
    EXPECT_GT(lit, 40'000);
}

/// One lane at a time holds a case while its neighbours hold NaN.
template <class P>
void expect_lanes_equal_scalars() {
    using T = nusselt::scalar_t<P>;
    HostileLines<T> lines(52);
    for (int i = 0; i < 4000; ++i) {
        const auto c = lines.next_ordinary(i);
        const int lane = i % nusselt::RealTraits<P>::kLanes;
        LineCaseOf<P> packed;
        std::memset(static_cast<void*>(&packed), 0xff, sizeof packed); // quiet NaN in every number
        set_lane<T>(packed, lane, c);
        const auto expected = results_of(c);
        const auto actual = get_lane<T, LineResults<T>>(results_of(packed), lane);
        ASSERT_TRUE(std::memcmp(&expected, &actual, sizeof expected) == 0) << hexadecimal<T>(c);
    }
}

TEST(LineLight, LanesEqualScalars) {
    expect_lanes_equal_scalars<NativeFloat>();
    expect_lanes_equal_scalars<NativeDouble>();
}

TEST(ReflectedOffsets, DensityFitsTheSamples) {
    const auto surface = fitting_surface(lobe_cases()[1].coefficients);
    for (const PolygonCase& c : polygon_cases()) {
        const auto light = make_light<double>(c);
        const LineFamily<double, 4> family(light, 0.7);
        const LineLight<double, FittingBrdf> estimator(family.plane(), family.reach(), surface);
        const ReflectedOffsets<double, 4> offsets(family, estimator);
        // The density is du / d offset.
        constexpr int kSteps = 4000;
        double previous = offsets.sample(0).offset;
        for (int i = 0; i < kSteps; ++i) {
            const double end = offsets.sample((i + 1.0) / kSteps).offset;
            const auto middle = offsets.sample((i + 0.5) / kSteps);
            ASSERT_GE(end, previous);
            // Densities may go to 0 at either end.
            const bool is_inside = i > kSteps / 100 && i < kSteps * 99 / 100;
            ASSERT_NEAR(is_inside ? (end - previous) * middle.pdf * kSteps : 1, 1, 0.05) << c.name;
            previous = end;
        }
        const double extent = family.offsets().end - family.offsets().begin;
        EXPECT_NEAR(offsets.sample(0).offset, family.offsets().begin, 1e-7 * extent);
        EXPECT_NEAR(previous, family.offsets().end, 1e-7 * extent);
    }
}

TEST(ReflectedOffsets, LessNoiseThanByLength) {
    const auto surface = fitting_surface(lobe_cases()[1].coefficients);
    for (const PolygonCase& c : polygon_cases()) {
        const auto light = make_light<double>(c);
        const LineFamily<double, 4> family(light, 0.7);
        const LineLight<double, FittingBrdf> estimator(family.plane(), family.reach(), surface);
        const ReflectedOffsets<double, 4> offsets(family, estimator);
        const auto variance = [&](const auto& sample) {
            double sum = 0;
            double squares = 0;
            constexpr int kLines = 2000;
            for (int i = 0; i < kLines; ++i) {
                const auto choice = sample((i + 0.5) / kLines);
                const CutLine<double> line(family.chord(choice.offset).extent, {});
                const auto light_of_line = estimator.analytic(choice.offset, line.parts);
                const double x = (light_of_line.diffuse.y + light_of_line.specular.y) / choice.pdf;
                sum += x / kLines;
                squares += x * x / kLines;
            }
            return squares / (sum * sum) - 1;
        };
        EXPECT_LT(variance([&](double u) { return offsets.sample(u); }),
                  0.3 * variance([&](double u) { return family.sample_by_length(u); }) + 0.01)
            << c.name;
    }
}

TEST(ReflectedOffsets, FindsHighlightsOfAnyWidth) {
    const auto light = make_light<double>(
        PolygonCase{"ceiling", {{-0.8, -0.7, 1.8}, {-0.8, 0.9, 1.8}, {1.1, 0.9, 1.8}, {1.1, -0.7, 1.8}}});
    for (const double width : {0.03, 0.01, 1e-3, 1e-4})
        for (const double tilt : {-0.3, 0.123}) {
            const auto surface = fitting_surface({1 / width, -tilt / width, 1 / width, 0, 1, 1});
            for (const double angle : {0.0, 0.7, 2.0}) {
                const LineFamily<double, 4> family(light, angle);
                const LineLight<double, FittingBrdf> estimator(family.plane(), family.reach(), surface);
                const ReflectedOffsets<double, 4> offsets(family, estimator);
                double sum = 0;
                double squares = 0;
                constexpr int kLines = 1000;
                for (int i = 0; i < kLines; ++i) {
                    const auto choice = offsets.sample((i + 0.5) / kLines);
                    const CutLine<double> line(family.chord(choice.offset).extent, {});
                    const double x =
                        estimator.analytic(choice.offset, line.parts).specular.y / choice.pdf / kSpecular.y;
                    sum += x / kLines;
                    squares += x * x / kLines;
                }
                // The light covers the lobe except for its tails.
                EXPECT_NEAR(sum, 1, 0.02) << width;
                EXPECT_LT(squares / (sum * sum) - 1, 0.4) << width;
            }
        }
}

TEST(ReflectedOffsets, BlackSurfacesSampleByLength) {
    const auto light = make_light<double>(polygon_cases()[0]);
    const LineFamily<double, 4> family(light, 0);
    auto surface = fitting_surface(lobe_cases()[0].coefficients);
    surface.diffuse_albedo = surface.specular_albedo = {0, 0, 0};
    const LineLight<double, FittingBrdf> estimator(family.plane(), family.reach(), surface);
    const ReflectedOffsets<double, 4> offsets(family, estimator);
    for (const double u : {0.1, 0.5, 0.8}) {
        EXPECT_NEAR(offsets.sample(u).offset, family.sample_by_length(u).offset, 1e-12);
        EXPECT_NEAR(offsets.sample(u).pdf, family.sample_by_length(u).pdf, 1e-12);
    }
}

TEST(ReflectedOffsets, HostileLightsGetFiniteOffsets) {
    HostileReflections<float> reflections(56);
    int drawn = 0;
    for (int i = 0; i < 20'000; ++i) {
        const auto c = reflections.next<PolygonReflection<float>>();
        const LineFamily<float, 4> family(c.light, 0.7f);
        const auto surface = c.surface();
        const LineLight<float> light(family.plane(), family.reach(), surface);
        const auto choice = ReflectedOffsets<float, 4>(family, light).sample(c.u[0].x);
        ASSERT_TRUE(std::isfinite(choice.pdf) && choice.pdf >= 0) << hexadecimal<float>(c);
        const auto offsets = family.offsets();
        const float rounding = 1e-6f * (offsets.end - offsets.begin) +
                               1e-6f * std::max(std::abs(offsets.begin), std::abs(offsets.end));
        ASSERT_GE(choice.offset, offsets.begin - rounding) << hexadecimal<float>(c);
        ASSERT_LE(choice.offset, offsets.end + rounding) << hexadecimal<float>(c);
        drawn += choice.pdf > 0;
    }
    EXPECT_GT(drawn, 10'000);
}

TEST(ReflectedOffsets, LanesEqualScalars) {
    using P = NativeFloat;
    constexpr int kLanes = nusselt::RealTraits<P>::kLanes;
    HostileReflections<float> reflections(54);
    for (int i = 0; i < 200; ++i) {
        PolygonReflection<float> c;
        reflections.fill(c);
        const auto cases = polygon_cases();
        c.light = make_light<float>(cases[static_cast<std::size_t>(i) % cases.size()]);
        PolygonReflection<P> packed;
        for (int lane = 0; lane < kLanes; ++lane) set_lane<float>(packed, lane, c);
        const LineFamily<float, 4> family(c.light, 0.7f);
        const LineFamily<P, 4> families(family);
        const auto surface = c.surface();
        const auto surfaces = packed.surface();
        const ReflectedOffsets<float, 4> offsets(family,
                                                 LineLight<float>(family.plane(), family.reach(), surface));
        const ReflectedOffsets<P, 4> many(families,
                                          LineLight<P>(families.plane(), families.reach(), surfaces));
        P u = P(0.f);
        for (int lane = 0; lane < kLanes; ++lane)
            u.set_lane(lane, (static_cast<float>(lane) + 0.5f) / static_cast<float>(kLanes));
        const auto chosen = many.sample(u);
        for (int lane = 0; lane < kLanes; ++lane) {
            const auto expected = offsets.sample(u.lane(lane));
            ASSERT_EQ(chosen.offset.lane(lane), expected.offset) << hexadecimal<float>(c);
            ASSERT_EQ(chosen.pdf.lane(lane), expected.pdf) << hexadecimal<float>(c);
        }
    }
}

} // namespace
} // namespace nusselt_test
