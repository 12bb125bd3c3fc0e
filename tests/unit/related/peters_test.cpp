/// The transcriptions of published formulas with which benches compare: packs have to compute what scalars compute, and
/// both what our techniques compute, up to the errors of the formulas.

#include <nusselt/related/bitonic_network.h>
#include <nusselt/related/line_projected_solid_angle_peters.h>
#include <nusselt/related/line_solid_angle_peters.h>
#include <nusselt/related/polygon_projected_solid_angle_peters.h>
#include <nusselt/related/polygon_solid_angle_peters.h>

#include "lab/timing/scalar/lights.h"
#include "sampling/techniques.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace nusselt {

namespace {

using lab::LightClass;
using nusselt_test::get_lane;
using nusselt_test::set_lane;

/// A light of a class, as a technique takes it.
template <class Light>
struct Maker;
template <int N>
struct Maker<ConvexPolygon<float, N>> {
    template <class Real>
    using LightOf = ConvexPolygon<Real, N>;
    static ConvexPolygon<float, N> make(const LightClass& c, std::mt19937& generator) {
        const auto corners = lab::random_light(c, N, generator);
        Vec3<float> v[N];
        for (int j = 0; j < N; ++j) v[j] = broadcast<float>(corners[static_cast<std::size_t>(j)]);
        return make_polygon<N>(v, N);
    }
};
template <>
struct Maker<LineSegment<float>> {
    template <class Real>
    using LightOf = LineSegment<Real>;
    static LineSegment<float> make(const LightClass& c, std::mt19937& generator) {
        const auto corners = lab::random_light(c, 2, generator);
        return make_line(broadcast<float>(corners[0]), broadcast<float>(corners[1]));
    }
};

double distance_of(const Vec3<float>& a, const Vec3<float>& b) { return std::sqrt(dot(a - b, a - b)); }

/// Compares a technique in packs and in scalars, and with ours.
/// \param lights    a class of lights for which the formulas are made: no corners on the horizon.
/// \param tolerance for directions, and relative for measures and densities: bounds the errors of the formulas.
template <template <class> class Published, template <class> class Ours, class Light>
void expect_agreement(const LightClass& lights, double tolerance) {
    constexpr int kLanes = 8;
    using Real = Pack<float, kLanes>;
    std::mt19937 generator(7);
    std::uniform_real_distribution<float> uniform(0.01f, 0.99f);
    for (int group = 0; group < 40; ++group) {
        std::vector<Light> light;
        std::vector<Vec2<float>> u;
        typename Maker<Light>::template LightOf<Real> packed;
        Vec2<Real> packed_u;
        for (int lane = 0; lane < kLanes; ++lane) {
            light.push_back(Maker<Light>::make(lights, generator));
            u.push_back({uniform(generator), uniform(generator)});
            set_lane<float>(packed, lane, light.back());
            set_lane<float>(packed_u, lane, u.back());
        }
        const Published<Real> packs(packed);
        const LightSample<Real> samples = draw(packs, packed_u);
        for (int lane = 0; lane < kLanes; ++lane) {
            const auto i = static_cast<std::size_t>(lane);
            const Published<float> scalar(light[i]);
            const LightSample<float> sample = draw(scalar, u[i]);
            const auto wi = get_lane<float, Vec3<float>>(samples.wi, lane);
            const auto p = get_lane<float, Vec3<float>>(samples.p, lane);
            EXPECT_NEAR(packs.measure().lane(lane) / scalar.measure(), 1, tolerance) << lights.name;
            EXPECT_NEAR(samples.pdf.lane(lane) / sample.pdf, 1, tolerance) << lights.name;
            EXPECT_LE(distance_of(wi, sample.wi), tolerance) << lights.name;
            EXPECT_LE(distance_of(p, sample.p), 4 * tolerance) << lights.name;

            const Ours<float> ours(light[i]);
            EXPECT_NEAR(scalar.measure() / ours.measure(), 1, tolerance) << lights.name;
            EXPECT_NEAR(sample.pdf / ours.pdf(sample.wi), 1, tolerance) << lights.name;
        }
    }
}

// Benches find functions by these templates of one parameter.
template <int N>
struct OfPolygon {
    template <class Real>
    using Projected = PolygonProjectedSolidAnglePeters<Real, N>;
    template <class Real>
    using OurProjected = PolygonProjectedSolidAngle<Real, N>;
    template <class Real>
    using SolidAngle = PolygonSolidAnglePeters<Real, N>;
    template <class Real>
    using OurSolidAngle = PolygonSolidAngle<Real, N>;
};
template <class Real>
using OurLineProjected = LineProjectedSolidAngle<Real>;

// The difference of two arctangents and directions to lights seen edge-on lose digits. Each bound is at least twice the
// largest deviation among 4096 lights (5e-3 for 8 vertices), and ten times that among the lights of these tests in others.
constexpr double kOfDifferences = 1e-2;
constexpr double kOfRoundedDirections = 5e-4;
constexpr double kOfLines = 1.5e-3;
constexpr double kOfSums = 2e-5;

template <int N>
void expect_agreement_of_polygons() {
    using Light = ConvexPolygon<float, N>;
    using Of = OfPolygon<N>;
    expect_agreement<Of::template Projected, Of::template OurProjected, Light>(lab::kDecentral,
                                                                               kOfDifferences);
    expect_agreement<Of::template Projected, Of::template OurProjected, Light>(lab::kCentral, kOfSums);
    expect_agreement<Of::template SolidAngle, Of::template OurSolidAngle, Light>(lab::kDecentral,
                                                                                 kOfRoundedDirections);
}

TEST(PetersFormulas, AreTheSameForPolygonsInPacksAndScalars) {
    expect_agreement_of_polygons<3>();
    expect_agreement_of_polygons<4>();
    expect_agreement_of_polygons<5>();
}

TEST(PetersFormulas, AreTheSameForLinesInPacksAndScalars) {
    using Light = LineSegment<float>;
    for (const LightClass& lights : {lab::kLineAbove, lab::kCentral}) {
        expect_agreement<LineProjectedSolidAnglePeters, OurLineProjected, Light>(lights, kOfLines);
        expect_agreement<LineSolidAnglePeters, LineSolidAngle, Light>(lights, kOfLines);
    }
}

TEST(PetersFormulas, ClipLightsInPacksAsInScalars) {
    // High enough above the horizon for the formulas, and yet with corners below it.
    constexpr LightClass kClipped = {"clipped", 0.15, 0.2, 0.4, false};
    using Of = OfPolygon<4>;
    expect_agreement<Of::Projected, Of::OurProjected, ConvexPolygon<float, 4>>(kClipped, kOfDifferences);
    expect_agreement<LineProjectedSolidAnglePeters, OurLineProjected, LineSegment<float>>(kClipped, kOfLines);
}

TEST(PetersFormulas, HaveNoMeasureBelowTheHorizon) {
    constexpr LightClass kBelow = {"below", -0.7, -0.6, 0.3, false};
    std::mt19937 generator(1);
    using Polygon = ConvexPolygon<float, 4>;
    using Line = LineSegment<float>;
    EXPECT_EQ((PolygonProjectedSolidAnglePeters<float, 4>(Maker<Polygon>::make(kBelow, generator)).measure()),
              0);
    const auto line = Maker<Line>::make(kBelow, generator);
    EXPECT_EQ(LineProjectedSolidAnglePeters<float>(line).measure(), 0);
    using Real = Pack<float, 4>;
    const LineSegment<Real> packed = broadcast<Real>(line);
    EXPECT_EQ(LineProjectedSolidAnglePeters<Real>(packed).measure().lane(3), 0);
}

/// Sorts a rotation of rising and falling numbers.
template <int M>
bool sorts_all_bitonic() {
    for (int start = 0; start < M; ++start)
        for (int length = 1; length < M; ++length) {
            // It suffices to sort zeros and ones (Knuth, The Art of Computer Programming, vol. 3, Sec. 5.3.4).
            std::array<int, M> values{};
            for (int i = 0; i < length; ++i) values[static_cast<std::size_t>((start + i) % M)] = 1;
            sort_bitonic<M>([&](int low, int high) {
                auto &a = values[static_cast<std::size_t>(low)], &b = values[static_cast<std::size_t>(high)];
                if (b < a) std::swap(a, b);
            });
            if (!std::is_sorted(values.begin(), values.end())) return false;
        }
    return true;
}

TEST(BitonicNetwork, SortsRotationsOfRisingAndFallingNumbers) {
    EXPECT_TRUE(sorts_all_bitonic<3>());
    EXPECT_TRUE(sorts_all_bitonic<4>());
    EXPECT_TRUE(sorts_all_bitonic<5>());
    EXPECT_TRUE(sorts_all_bitonic<6>());
    EXPECT_TRUE(sorts_all_bitonic<7>());
    EXPECT_TRUE(sorts_all_bitonic<8>());
    EXPECT_TRUE(sorts_all_bitonic<9>());
}

TEST(PetersArithmetic, IsAccurate) {
    // The bounds in the header plus the rounding of the result.
    for (int i = 1; i < 3000; ++i) {
        const float angle = 3.1415926f * static_cast<float>(i) / 3000;
        const double exact = angle;
        const auto y = static_cast<float>(std::sin(exact)), x = static_cast<float>(std::cos(exact));
        EXPECT_NEAR(peters::atan2_positive(y, x), std::atan2(static_cast<double>(y), x), 4e-7 * exact + 1e-9);
        const SinCos<float> half = peters::sincos_half_turn(angle);
        EXPECT_NEAR(half.sin, std::sin(exact), 3e-7);
        EXPECT_NEAR(half.cos, std::cos(exact), 3e-7);
        const SinCos<float> around = peters::sincos_around_zero(angle / 2 - 0.75f);
        EXPECT_NEAR(around.sin, std::sin(static_cast<double>(angle / 2 - 0.75f)), 3e-7);
    }
}

} // namespace

} // namespace nusselt
