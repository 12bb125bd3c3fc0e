/// Compares the density of a technique with the Jacobian of its map, and its integrals with references that share no
/// formula with the library: quadrature for lines, Girard's and Lambert's formulas for polygons.

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "geometry/adaptive_quadrature.h"
#include "lights.h"
#include "lit_part.h"

namespace nusselt_test {
namespace {

template <class Test>
class DensityTest : public ::testing::Test {};

/// The name of the suite in techniques.json.
struct DensitySuite {
    static constexpr std::string_view kName = "density";
};
/// Polygons with many vertices and cylinders are tested on lobes in double only, because they share their code with
/// the techniques that are also tested in long double.
using Types = decltype(detail::types_of(
    detail::instances_of<double, long double>(
        TestedBy<DensitySuite, PolygonKinds<4>, PolygonKinds<8>, RectangleKinds, PolygonOnLobeKinds<4>,
                 LineKinds, LineOnLobeKinds, CylinderKinds>()) +
    detail::instances_of<double>(TestedBy<DensitySuite, PolygonOnLobeKinds<8>, CylinderOnLobeKinds>())));
TYPED_TEST_SUITE(DensityTest, Types, InstanceNames);

/// Rounding of 64 terms in double. The largest error is 1.5e-15.
constexpr double kProjectedBudget = 1e-14;
/// The midpoint rule converges like 1 / count^2, like 1 / count^1.5 at the root at u.y = 0, and like 1 / count where
/// the integrand has a kink on the horizon. On the coarse grid, the largest error is 0.052, for uniform area sampling
/// of the light that is large and close. The fine grid at least halves each error until it is negligible.
constexpr double kCoarseBudget = 0.1;
constexpr double kFineBudget = 1e-4;
/// For solid angle techniques, the integrand is constant and the error is the rounding of 25600 terms, 7e-13 at most.
/// Uniform area sampling reaches 2.1e-4 and projected solid angle sampling 7.1e-3, for the light that is large and
/// close.
template <class Kind>
constexpr double kSolidAngleBudget = Kind::kMeasure == Measure::solid_angle ? 2e-12
                                     : Kind::kMeasure == Measure::area      ? 5e-4
                                                                            : 1.5e-2;
/// Girard's formula in long double has a relative error of up to 3e-15 for the smallest light. All other errors are
/// below 5e-16 in double.
constexpr double kMeasureBudget = 1e-14;

/// Solid angle per du (polygons), or solid angle per du and radius (lines), at u, by central differences.
template <class Technique, class T, int N>
T jacobian(const Technique& technique, const nusselt::ConvexPolygon<T, N>&, const nusselt::Vec2<T>& u, T h) {
    const auto wi = [&](T x, T y) { return technique.sample({x, y}).wi; };
    const auto by_x = wi(u.x + h, u.y) - wi(u.x - h, u.y);
    const auto by_y = wi(u.x, u.y + h) - wi(u.x, u.y - h);
    return length(cross(by_x, by_y)) / (4 * h * h);
}
template <class Technique, class T>
T jacobian(const Technique& technique, const nusselt::LineSegment<T>& line, T u, T h) {
    // A thin cylinder of radius R at distance r subtends 2 R / r across; if the axis is at a given distance, 1 / r =
    // cos(alpha) / distance.
    const T angle = length(technique.sample(u + h).wi - technique.sample(u - h).wi);
    const T distance = length(cross(line.p0, line.s));
    const T cosine = length(cross(technique.sample(u).wi, line.s));
    return 2 * cosine / distance * angle / (2 * h);
}

TYPED_TEST(DensityTest, IsTheReciprocalOfTheJacobian) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    // The differences have errors of about 1000 h^2 (third derivatives) plus rounding over h, which the small light
    // of the list amplifies a hundred times.
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

/// The function to which the density of a technique should be proportional: the lobe, or else the cosine.
template <class Kind, class Light>
auto importance(const Light& light) {
    if constexpr (kHasLobe<Kind>) {
        return [lobe = ReferenceLobe(light.lobe)](const Point& wi) { return lobe.density(wi); };
    } else {
        return [](const Point& wi) { return std::max(wi.z, 0.0L); };
    }
}

long double reference_area(const Polygon& polygon) {
    return integrate(
        polygon, [](const Point&) { return 1.0L; }, 1);
}
long double reference_area(const Segment& line) { return length(line.end - line.begin); }

long double reference_solid_angle(const Polygon& polygon) { return girard(polygon); }
/// Integral of f(wi) over the solid angle per radius: a thin cylinder of radius R is 2 R sin(angle to the axis) wide.
/// The panels are short enough for a smooth integrand on each, even where a long light is close.
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

/// The integral of the square of a function over the solid angle.
template <class Function>
long double reference_square(const Polygon& polygon, const Function& f) {
    return integrate_solid_angle(
        polygon, [&](const Point& wi) { return f(wi) * f(wi); }, 1e-9L);
}
template <class Function>
long double reference_square(const Segment& line, const Function& f) {
    return integrate_directions(line, [&](const Point& wi) { return f(wi) * f(wi); });
}

/// The integral of importance() over the part of a light that a technique can reach.
template <class Kind, class Light>
long double reference_importance(const Light& light) {
    const auto part = lit_part<Kind>(light);
    if constexpr (!kIsPolygon<Kind>) {
        return integrate_directions(part, importance<Kind>(light));
    } else if constexpr (kHasLobe<Kind>) {
        return ReferenceLobe(light.lobe).integral(part);
    } else {
        return lambert(above_horizon(part));
    }
}

/// Mean of f(sample) / pdf over a grid of random numbers.
template <class Kind, class Technique, class Function>
long double estimate(const Technique& technique, int count, const Function& f) {
    using T = decltype(technique.measure());
    long double sum = 0;
    const auto points = midpoints<Kind, T>(count);
    for (const auto& u : points) {
        const auto sample = technique.sample(u);
        if (sample.pdf > 0) sum += f(nusselt::broadcast<long double>(sample.wi)) / sample.pdf;
    }
    return sum / static_cast<long double>(points.size());
}

TYPED_TEST(DensityTest, EstimatesImportance) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        const long double expected = reference_importance<Kind>(local);
        const auto error = [&](int count) {
            return std::fabs(estimate<Kind>(technique, count, importance<Kind>(local)) / expected - 1);
        };
        if (Kind::kMeasure == Measure::projected_solid_angle || kHasLobe<Kind>) {
            // The estimate has no variance, so the error is rounding only.
            EXPECT_LE(error(8), kProjectedBudget) << light.name;
            continue;
        }
        const auto coarse = error(kIsPolygon<Kind> ? 40 : 1500);
        const auto fine = error(kIsPolygon<Kind> ? 160 : 6000);
        EXPECT_LE(coarse, kCoarseBudget) << light.name;
        EXPECT_LE(fine, std::max(coarse / 2, static_cast<long double>(kFineBudget))) << light.name;
    }
}

TYPED_TEST(DensityTest, EstimatesSolidAngle) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    constexpr int kCount = kIsPolygon<Kind> ? 160 : 6000;
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        const auto part = lit_part<Kind>(local);
        if constexpr (Kind::kMeasure == Measure::projected_solid_angle || kHasLobe<Kind>) {
            // The density vanishes on the horizon, so an estimate of the solid angle has no finite variance. That of
            // the integral of the squared cosine or lobe has, and this integral does not depend on the technique
            // either.
            const auto f = importance<Kind>(local);
            const long double expected = reference_square(part, f);
            const auto squared = [&](const Point& wi) { return f(wi) * f(wi); };
            EXPECT_NEAR(estimate<Kind>(technique, kCount, squared) / expected, 1, kSolidAngleBudget<Kind>)
                << light.name;
        } else {
            const auto one = [](const Point&) { return 1.0L; };
            const long double expected = reference_solid_angle(part);
            EXPECT_NEAR(estimate<Kind>(technique, kCount, one) / expected, 1, kSolidAngleBudget<Kind>)
                << light.name;
        }
    }
}

TYPED_TEST(DensityTest, MeasureIsThatOfTheReference) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        const auto part = lit_part<Kind>(local);
        const long double expected = Kind::kMeasure == Measure::area ? reference_area(part)
                                     : Kind::kMeasure == Measure::solid_angle
                                         ? reference_solid_angle(part)
                                         : reference_importance<Kind>(local);
        EXPECT_NEAR(technique.measure() / expected, 1, kMeasureBudget) << light.name;
    }
}

} // namespace
} // namespace nusselt_test
