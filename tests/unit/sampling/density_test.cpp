/// The density of a technique against the Jacobian of its map, and its integrals against closed forms.

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include <nusselt/geometry/clip_line.h>
#include <nusselt/geometry/polygon_measures.h>

#include "lights.h"

namespace nusselt_test {
namespace {

template <class Test>
class DensityTest : public ::testing::Test {};

template <class Kind>
using Precise = ::testing::Types<Instance<Kind, double>, Instance<Kind, long double>>;

TYPED_TEST_SUITE_P(DensityTest);

/// Solid angle per du (polygons), or solid angle per du and radius (lines), at u by central differences.
template <class Technique, class T>
T jacobian(const Technique& technique, const nusselt::ConvexPolygon<T, 4>&, const nusselt::Vec2<T>& u, T h) {
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

template <class T>
T solid_angle_above_horizon(const nusselt::ConvexPolygon<T, 4>& polygon) {
    return solid_angle(clip_to_horizon(polygon));
}
template <class T>
T solid_angle_above_horizon(const nusselt::LineSegment<T>& line) {
    const auto extent = clipped_extent(line);
    return 2 * extent.sine_extent() / extent.distance;
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
        const T expected = projected_solid_angle(local);
        const auto error = [&](int count) {
            return std::fabs(estimate<Kind, T>(technique, count, cosine) / expected - 1);
        };
        if (Kind::kMeasure == Measure::kProjectedSolidAngle) {
            EXPECT_LE(error(8), 1e-13) << light.name; // the estimate has no variance
            continue;
        }
        // The midpoint rule converges like 1 / count^2, like 1 / count^1.5 where it meets the root at u.y = 0
        // and like 1 / count where the integrand has a kink on the horizon.
        const T coarse = error(kIsPolygon<Kind> ? 40 : 1500);
        const T fine = error(kIsPolygon<Kind> ? 160 : 6000);
        EXPECT_LE(coarse, 0.1) << light.name;
        EXPECT_LE(fine, std::max(coarse / 2, T(1e-4))) << light.name;
    }
}

TYPED_TEST_P(DensityTest, EstimatesSolidAngle) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    // Its density vanishes on the horizon, so that the variance of this estimate does not exist.
    if (Kind::kMeasure == Measure::kProjectedSolidAngle) return;
    const auto one = [](const nusselt::Vec3<T>& wi) { return wi.z > 0 ? T(1) : T(0); };
    for (const auto& light : cases<Kind>()) {
        // The midpoint rule is of no use for a step at the horizon.
        if (light.name.find("floor") != std::string::npos ||
            light.name.find("clipped") != std::string::npos ||
            light.name.find("below") != std::string::npos || light.name == "octant") {
            continue;
        }
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        const T expected = solid_angle_above_horizon(local);
        const T estimated = estimate<Kind, T>(technique, kIsPolygon<Kind> ? 160 : 6000, one);
        EXPECT_NEAR(estimated / expected, 1, 5e-3) << light.name;
    }
}

TYPED_TEST_P(DensityTest, MeasureIsTheClosedForm) {
    using T = typename TypeParam::Real;
    using Kind = typename TypeParam::Kind;
    for (const auto& light : cases<Kind>()) {
        const auto local = light_for<Kind, T>(light);
        const typename TypeParam::Technique technique(local);
        T expected = 0;
        if constexpr (Kind::kMeasure == Measure::kArea) {
            if constexpr (kIsPolygon<Kind>) {
                expected = area(local);
            } else {
                expected = local.length;
            }
        } else if constexpr (Kind::kMeasure == Measure::kProjectedSolidAngle) {
            expected = projected_solid_angle(local);
        } else if constexpr (Kind::kHorizon == Horizon::kClipped) {
            expected = solid_angle_above_horizon(local);
        } else {
            expected = solid_angle(local);
        }
        EXPECT_NEAR(technique.measure() / expected, 1, 4000 * std::numeric_limits<T>::epsilon())
            << light.name;
    }
}

REGISTER_TYPED_TEST_SUITE_P(DensityTest, IsTheReciprocalOfTheJacobian, EstimatesProjectedSolidAngle,
                            EstimatesSolidAngle, MeasureIsTheClosedForm);

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
