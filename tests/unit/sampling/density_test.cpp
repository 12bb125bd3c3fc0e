/// The density of a technique against the Jacobian of its map, and its integrals against references that share no formula
/// with the library: quadrature for lines, Girard's and Lambert's formulas for polygons.

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "geometry/reference.h"
#include "lights.h"

namespace nusselt_test {
namespace {

template <class Test>
class DensityTest : public ::testing::Test {};

template <class Kind>
using Precise = ::testing::Types<Instance<Kind, double>, Instance<Kind, long double>>;

TYPED_TEST_SUITE_P(DensityTest);

/// Rounding of 64 terms in double; 1.5e-15 is the largest error.
constexpr double kProjectedBudget = 1e-14;
/// The midpoint rule converges like 1 / count^2, like 1 / count^1.5 where it meets the root at u.y = 0 and like 1 / count
/// where the integrand has a kink on the horizon. The largest error on the coarse grid is 0.052, that of uniform area
/// sampling of the light that is large and close; on the fine one it halves at least, until it is negligible.
constexpr double kCoarseBudget = 0.1;
constexpr double kFineBudget = 1e-4;
/// The integrand is constant for solid angle techniques: rounding of 25600 terms, 7e-13 at most. Uniform area sampling
/// reaches 2.1e-4 and projected solid angle sampling, where the light is large and close, 7.1e-3.
template <class Kind>
constexpr double kSolidAngleBudget = Kind::kMeasure == Measure::kSolidAngle ? 2e-12
                                     : Kind::kMeasure == Measure::kArea     ? 5e-4
                                                                            : 1.5e-2;
/// Girard's formula in long double loses up to 3e-15 of the smallest light; everything else errs by 5e-16 in double.
constexpr double kMeasureBudget = 1e-14;

/// Solid angle per du (polygons), or solid angle per du and radius (lines), at u by central differences.
template <class Technique, class T, int N>
T jacobian(const Technique& technique, const nusselt::ConvexPolygon<T, N>&, const nusselt::Vec2<T>& u, T h) {
    const auto wi = [&](T x, T y) { return technique.sample({x, y}).wi; };
    const auto by_x = wi(u.x + h, u.y) - wi(u.x - h, u.y);
    const auto by_y = wi(u.x, u.y + h) - wi(u.x, u.y - h);
    return length(cross(by_x, by_y)) / (4 * h * h);
}
template <class Technique, class T>
T jacobian(const Technique& technique, const nusselt::LineSegment<T>& line, T u, T h) {
    // A thin cylinder of radius R at distance r subtends 2 R / r across; with the distance of the axis,
    // 1 / r = cos(alpha) / distance.
    const T angle = length(technique.sample(u + h).wi - technique.sample(u - h).wi);
    const T distance = length(cross(line.p0, line.s));
    const T cosine = length(cross(technique.sample(u).wi, line.s));
    return 2 * cosine / distance * angle / (2 * h);
}

TYPED_TEST_P(DensityTest, IsTheReciprocalOfTheJacobian) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    // Differences err by about 1000 h^2 (third derivatives) and by rounding over h, which the small light of
    // the list amplifies a hundred times.
    constexpr T kStep = sizeof(T) > sizeof(double) ? T(5e-7) : T(2e-5);
    constexpr T kTolerance = sizeof(T) > sizeof(double) ? T(2e-9) : T(2e-6);
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        for (const auto& u : midpoints<Kind, T>(8)) {
            const T pdf = technique.sample(u).pdf;
            EXPECT_NEAR(pdf * jacobian(technique, local, u, kStep), 1, kTolerance) << light.name;
        }
    }
}

/// The part of a light that a technique can reach.
template <class T, int N>
Polygon lit_part(const nusselt::ConvexPolygon<T, N>& light, Horizon horizon) {
    const Polygon whole = vertices_of(light);
    return horizon == Horizon::kClipped ? above_horizon(whole) : whole;
}
struct Segment {
    Point begin, end;
};
template <class T>
Segment lit_part(const nusselt::LineSegment<T>& light, Horizon horizon) {
    Segment part{widened_begin(light), widened_end(light)};
    const Point crossing =
        part.begin + (part.begin.z / (part.begin.z - part.end.z)) * (part.end - part.begin);
    if (horizon == Horizon::kClipped && part.begin.z < 0) part.begin = crossing;
    if (horizon == Horizon::kClipped && part.end.z < 0) part.end = crossing;
    return part;
}

long double reference_area(const Polygon& polygon) {
    return integrate(
        polygon, [](const Point&) { return 1.0L; }, 1);
}
long double reference_area(const Segment& line) { return length(line.end - line.begin); }

long double reference_solid_angle(const Polygon& polygon) { return girard(polygon); }
/// Integral of f(wi) over the solid angle per radius: a thin cylinder of radius R is 2 R sin(angle to the axis) wide.
/// Panels are so short that the integrand is smooth on each, also where a long light is close.
template <class Integrand>
long double integrate_directions(const Segment& line, const Integrand& f) {
    constexpr int kPanels = 64;
    const Point step = (1.0L / kPanels) * (line.end - line.begin);
    const Point s = normalize(step);
    long double sum = 0;
    for (int i = 0; i < kPanels; ++i) {
        const Point begin = line.begin + static_cast<long double>(i) * step;
        const auto density = [&](const Point& p) {
            const Point wi = normalize(p);
            return f(wi) * 2 * length(cross(wi, s)) / dot(p, p);
        };
        sum += integrate(begin, begin + step, density, 40);
    }
    return sum;
}
long double reference_solid_angle(const Segment& line) {
    return integrate_directions(line, [](const Point&) { return 1.0L; });
}

/// The integral of the squared cosine over the solid angle.
long double reference_squared_cosine(const Polygon& polygon) {
    const Point normal = normalize(cross(polygon[1] - polygon[0], polygon[2] - polygon[0]));
    return integrate(
        polygon,
        [&](const Point& p) {
            const long double r2 = dot(p, p);
            return p.z * p.z * std::fabs(dot(normal, p)) / (r2 * r2 * std::sqrt(r2));
        },
        128);
}
long double reference_squared_cosine(const Segment& line) {
    return integrate_directions(line, [](const Point& wi) { return wi.z * wi.z; });
}

long double reference_projected_solid_angle(const Polygon& polygon) { return lambert(polygon); }
long double reference_projected_solid_angle(const Segment& line) {
    return integrate_directions(line, [](const Point& wi) { return wi.z; });
}

/// Mean of f(sample) / pdf over a grid of random numbers.
template <class Kind, class T, class Technique, class Function>
T estimate(const Technique& technique, int count, const Function& f) {
    T sum = 0;
    const auto points = midpoints<Kind, T>(count);
    for (const auto& u : points) {
        const auto sample = technique.sample(u);
        if (sample.pdf > 0) sum += f(sample.wi) / sample.pdf;
    }
    return sum / static_cast<T>(points.size());
}

TYPED_TEST_P(DensityTest, EstimatesProjectedSolidAngle) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    const auto cosine = [](const nusselt::Vec3<T>& wi) { return std::max(wi.z, T(0)); };
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        const long double expected = reference_projected_solid_angle(lit_part(local, Horizon::kClipped));
        const auto error = [&](int count) {
            return std::fabs(estimate<Kind, T>(technique, count, cosine) / expected - 1);
        };
        if (Kind::kMeasure == Measure::kProjectedSolidAngle) {
            // The estimate has no variance: rounding only.
            EXPECT_LE(error(8), kProjectedBudget) << light.name;
            continue;
        }
        const auto coarse = error(kIsPolygon<Kind> ? 40 : 1500);
        const auto fine = error(kIsPolygon<Kind> ? 160 : 6000);
        EXPECT_LE(coarse, kCoarseBudget) << light.name;
        EXPECT_LE(fine, std::max<long double>(coarse / 2, kFineBudget)) << light.name;
    }
}

TYPED_TEST_P(DensityTest, EstimatesSolidAngle) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        const Horizon horizon = Kind::kHorizon;
        if constexpr (Kind::kMeasure == Measure::kProjectedSolidAngle) {
            // The density vanishes on the horizon, so that the variance of this estimate does not exist. The solid
            // angle weighted by the squared cosine exists, and is as independent of the technique.
            const auto squared = [](const nusselt::Vec3<T>& wi) { return wi.z * wi.z; };
            const long double expected = reference_squared_cosine(lit_part(local, horizon));
            const T estimated = estimate<Kind, T>(technique, kIsPolygon<Kind> ? 160 : 6000, squared);
            EXPECT_NEAR(estimated / expected, 1, kSolidAngleBudget<Kind>) << light.name;
        } else {
            const auto one = [](const nusselt::Vec3<T>&) { return T(1); };
            const long double expected = reference_solid_angle(lit_part(local, horizon));
            const T estimated = estimate<Kind, T>(technique, kIsPolygon<Kind> ? 160 : 6000, one);
            EXPECT_NEAR(estimated / expected, 1, kSolidAngleBudget<Kind>) << light.name;
        }
    }
}

TYPED_TEST_P(DensityTest, MeasureIsThatOfTheReference) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        const auto part = lit_part(local, Kind::kHorizon);
        const long double expected = Kind::kMeasure == Measure::kArea ? reference_area(part)
                                     : Kind::kMeasure == Measure::kSolidAngle
                                         ? reference_solid_angle(part)
                                         : reference_projected_solid_angle(part);
        EXPECT_NEAR(technique.measure() / expected, 1, kMeasureBudget) << light.name;
    }
}

REGISTER_TYPED_TEST_SUITE_P(DensityTest, IsTheReciprocalOfTheJacobian, EstimatesProjectedSolidAngle,
                            EstimatesSolidAngle, MeasureIsThatOfTheReference);

INSTANTIATE_TYPED_TEST_SUITE_P(OctagonArea, DensityTest, Precise<PolygonAreaKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonSolidAngle, DensityTest, Precise<PolygonSolidAngleKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonClippedSolidAngle, DensityTest,
                               Precise<PolygonClippedSolidAngleKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(OctagonProjectedSolidAngle, DensityTest,
                               Precise<PolygonProjectedSolidAngleKindOf<8>>);
INSTANTIATE_TYPED_TEST_SUITE_P(PolygonArea, DensityTest, Precise<PolygonAreaKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(PolygonSolidAngle, DensityTest, Precise<PolygonSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(PolygonClippedSolidAngle, DensityTest, Precise<PolygonClippedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(PolygonProjectedSolidAngle, DensityTest,
                               Precise<PolygonProjectedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(LineArea, DensityTest, Precise<LineAreaKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(LineSolidAngle, DensityTest, Precise<LineSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(LineClippedSolidAngle, DensityTest, Precise<LineClippedSolidAngleKind>);
INSTANTIATE_TYPED_TEST_SUITE_P(LineProjectedSolidAngle, DensityTest, Precise<LineProjectedSolidAngleKind>);

} // namespace
} // namespace nusselt_test
