/// Tests of cylinders of finite radius: integrals and densities against quadrature over the surface, and the limit of
/// a thin cylinder.

#include <nusselt/related/cylinder_rejection_gamito.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/cylinder_reference.h"
#include "lights.h"
#include "ltc/reference.h"

namespace nusselt_test {
namespace {

template <class Kind>
class CylinderTest : public ::testing::Test {};

using Kinds = ::testing::Types<CylinderSolidAngleKind, CylinderProjectedSolidAngleKind, CylinderLtcKind>;
TYPED_TEST_SUITE(CylinderTest, Kinds);

/// Error for each part of the surface, relative to the integral.
constexpr long double kQuadratureTolerance = 2e-6L;
/// Relative error of estimates and integrals.
constexpr long double kBudget = 1e-4L;

/// The function to which the density of a technique should be almost proportional.
template <class Kind, class Light>
auto importance(const Light& light) {
    if constexpr (Kind::kMeasure == Measure::lobe) {
        return [lobe = ReferenceLobe(light.lobe)](const Point& wi) { return lobe.density(wi); };
    } else if constexpr (Kind::kMeasure == Measure::projected_solid_angle) {
        return [](const Point& wi) { return std::max(wi.z, 0.0L); };
    } else {
        return [](const Point&) { return 1.0L; };
    }
}

/// Mean and relative standard deviation of f / pdf.
struct Estimate {
    long double mean, deviation;
};

/// The weight hardly depends on u.y, so most nodes are in u.x.
template <class Technique, class Function>
Estimate estimate(const Technique& technique, const Function& f) {
    constexpr int kAround = 8192;
    constexpr int kAlong = 4;
    long double sum = 0;
    long double squares = 0;
    for (int i = 0; i < kAround; ++i) {
        for (int j = 0; j < kAlong; ++j) {
            const auto s = technique.sample({(i + 0.5) / kAround, (j + 0.5) / kAlong});
            if (!(s.pdf > 0)) continue;
            const long double weight = f(nusselt::broadcast<long double>(s.wi)) / s.pdf;
            sum += weight;
            squares += weight * weight;
        }
    }
    constexpr long double kCount = kAround * kAlong;
    const long double mean = sum / kCount;
    return {mean, std::sqrt(std::max(squares / kCount / (mean * mean) - 1, 0.0L))};
}

/// Bound on the standard deviation of the weights relative to their mean. In front of a cap, the integral over a
/// half-plane can fall from its largest value to nearly nothing within a small turn, with deviations of 0.48 and 0.29
/// at most. They are below 0.1 for all lights that are seen from the side.
template <class Kind>
constexpr long double kDeviationBudget = kHasLobe<Kind> ? 0.55L : 0.35L;

/// Errors of the interpolant are at most 0.075 without a lobe and 0.22 with one.
template <class Kind>
constexpr double kMeasureBudget = kHasLobe<Kind> ? 0.3 : 0.1;

TYPED_TEST(CylinderTest, EstimatesItsImportanceWithSmallVariance) {
    for (const auto& light : cases<TypeParam>()) {
        const auto local = light_for<TypeParam, double>(light);
        const auto f = importance<TypeParam>(local);
        const typename TypeParam::template Technique<double> technique(local);
        const long double expected =
            integrate_solid_angle(solid(local), f, kQuadratureTolerance * technique.measure());
        const Estimate found = estimate(technique, f);
        EXPECT_NEAR(found.mean / expected, 1, kBudget) << light.name;
        EXPECT_LE(found.deviation, kDeviationBudget<TypeParam>) << light.name;
        EXPECT_NEAR(technique.measure() / expected, 1, kMeasureBudget<TypeParam>) << light.name;
    }
}

TYPED_TEST(CylinderTest, DensityIntegratesToOne) {
    for (const auto& light : cases<TypeParam>()) {
        const auto local = light_for<TypeParam, double>(light);
        const typename TypeParam::template Technique<double> technique(local);
        const auto density = [&](const Point& wi) -> long double {
            return technique.pdf(nusselt::broadcast<double>(wi));
        };
        EXPECT_NEAR(integrate_solid_angle(solid(local), density, 3e-5L), 1, kBudget) << light.name;
    }
}

TYPED_TEST(CylinderTest, DensityIsTheReciprocalOfTheJacobian) {
    for (const auto& light : cases<TypeParam>()) {
        const typename TypeParam::template Technique<double> technique(light_for<TypeParam, double>(light));
        const auto wi = [&](double x, double y) { return technique.sample({x, y}).wi; };
        for (const auto& u : midpoints<TypeParam, double>(8)) {
            // The differences have errors of about 1000 h^2 (third derivatives) plus rounding over h.
            constexpr double kStep = 1e-5;
            const auto by_x = wi(u.x + kStep, u.y) - wi(u.x - kStep, u.y);
            const auto by_y = wi(u.x, u.y + kStep) - wi(u.x, u.y - kStep);
            const double jacobian = length(cross(by_x, by_y)) / (4 * kStep * kStep);
            EXPECT_NEAR(technique.sample(u).pdf * jacobian, 1, 1e-5) << light.name << u.x << " " << u.y;
        }
    }
}

/// For lights where rounding decides which side of the horizon, or of the lateral surface, something is on.
template <class T>
void expect_projected_solid_angle(const CylinderCase& light) {
    const auto cylinder = make_light<T>(light);
    const nusselt::CylinderProjectedSolidAngle<T> technique(cylinder);
    constexpr int kSide = 128;
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const auto s = technique.sample({(T(i % kSide) + T(0.5)) / kSide, (T(i / kSide) + T(0.5)) / kSide});
        if (s.pdf > 0) sum += s.wi.z / s.pdf / (kSide * kSide);
    }
    const auto cosine = [](const Point& wi) { return std::max(wi.z, 0.0L); };
    const auto expected = static_cast<double>(integrate_solid_angle(solid(cylinder), cosine, 1e-5L));
    EXPECT_NEAR(sum / expected, 1, 2e-3) << light.name;
    EXPECT_NEAR(static_cast<double>(technique.measure()) / expected, 1, 0.35) << light.name;
}

TEST(CylinderProjectedSolidAngleTest, LightsThatLieOnTheFloorAreSeen) {
    for (const double azimuth : {0.0, 0.7, 1.0, 1.5707963267948966, 2.5}) {
        const nusselt::Vec3<double> along{std::cos(azimuth), std::sin(azimuth), 0};
        for (const double height : {0.5, 0.499, 0.5 + 1e-7, 0.5 - 1e-7}) {
            const nusselt::Vec3<double> begin = nusselt::Vec3<double>{0.5, 0.3, height} + 0.5 * along;
            const CylinderCase light{"lying at " + std::to_string(azimuth), begin, begin + 2.0 * along, 0.5};
            expect_projected_solid_angle<float>(light);
            expect_projected_solid_angle<double>(light);
        }
    }
}

TEST(CylinderProjectedSolidAngleTest, LightsAboveAtADistanceOfTheRadiusAreSeen) {
    for (const double azimuth : {0.0, 0.7, 1.5707963267948966, 2.5}) {
        const nusselt::Vec3<double> begin{std::cos(azimuth), std::sin(azimuth), 0.3};
        const CylinderCase light{"above at " + std::to_string(azimuth), begin,
                                 begin + nusselt::Vec3<double>{0, 0, 1}, 1};
        expect_projected_solid_angle<float>(light);
        expect_projected_solid_angle<double>(light);
    }
}

/// A cylinder is dark for points inside it or on its lateral surface, and if its length or radius is zero.
TYPED_TEST(CylinderTest, IsDarkWithoutAnOutside) {
    const std::vector<CylinderCase> dark = {{"inside", {-1, 0.1, 0.1}, {1, 0.1, 0.1}, 0.5},
                                            {"on the side", {-1, 0, 0.5}, {1, 0, 0.5}, 0.5},
                                            {"no radius", {-1, 0.5, 1}, {1, 0.5, 1}, 0},
                                            {"no length", {1, 0.5, 1}, {1, 0.5, 1}, 0.25}};
    for (const CylinderCase& cylinder : dark) {
        typename TypeParam::template Light<float> light{};
        static_cast<nusselt::Cylinder<float>&>(light) = make_light<float>(cylinder);
        if constexpr (kHasLobe<TypeParam>) light.lobe = {1, 0, 1, 0, 1, 1};
        const typename TypeParam::template Technique<float> technique(light);
        EXPECT_EQ(technique.measure(), 0) << cylinder.name;
        EXPECT_EQ(technique.sample({0.3f, 0.6f}).pdf, 0) << cylinder.name;
        EXPECT_EQ(technique.pdf({0, 0, 1}), 0) << cylinder.name;
    }
}

/// A point next to the surface sees nothing once its distance is so small that the square underflows, or else samples unit
/// vectors.
TYPED_TEST(CylinderTest, SamplesUnitVectorsAtAnyDistance) {
    int lit = 0;
    for (int exponent = -80; exponent >= -110; --exponent) {
        for (const float fraction : {1.0f, 1.25f, 1.5f, 1.75f}) {
            const float distance = std::ldexp(fraction, exponent);
            typename TypeParam::template Light<float> light{};
            static_cast<nusselt::Cylinder<float>&>(light) = {
                {{0, 0.6f * distance, 0.8f * distance}, {1, 0, 0}, 1}, std::ldexp(1.0f, exponent - 5)};
            if constexpr (kHasLobe<TypeParam>) light.lobe = {1, 0, 1, 0, 1, 1};
            const typename TypeParam::template Technique<float> technique(light);
            if (technique.measure() > 0) ++lit;
            for (const float u : {0.0f, 0.3f, 0.9f})
                EXPECT_NEAR(length(technique.sample({0.4f, u}).wi), 1, 1e-5) << distance;
        }
    }
    EXPECT_GE(lit, 60);
}

/// The technique for linear lights to which that for a thin cylinder tends.
template <class Kind>
using LineKindOf = std::conditional_t<Kind::kMeasure == Measure::lobe, LineLtcKind,
                                      std::conditional_t<Kind::kMeasure == Measure::solid_angle,
                                                         LineSolidAngleKind, LineProjectedSolidAngleKind>>;

TYPED_TEST(CylinderTest, TendsToTheLinearLight) {
    using Line = LineKindOf<TypeParam>;
    for (const auto& line : cases<Line>()) {
        const auto limit = light_for<Line, double>(line);
        const typename Line::template Technique<double> linear(limit);
        for (const double radius : {1e-4, 1e-6}) {
            typename TypeParam::template Light<double> light{};
            static_cast<nusselt::Cylinder<double>&>(light) = {limit, radius};
            if constexpr (kHasLobe<TypeParam>) light.lobe = limit.lobe;
            const typename TypeParam::template Technique<double> technique(light);
            EXPECT_NEAR(technique.measure() / (radius * linear.measure()), 1, 100 * radius) << line.name;
            for (const double u : {0.25, 0.5, 0.75}) {
                const auto expected = linear.sample(u);
                const auto found = technique.sample({0.5, u});
                EXPECT_NEAR(found.pdf * radius / expected.pdf, 1, 300 * radius) << line.name;
                EXPECT_LE(length(found.wi - expected.wi), 100 * radius) << line.name;
            }
        }
    }
}

/// Among rays in all directions, those within the outline of the cylinder hit it, at the first point of its surface.
TEST(CylinderIntersectionTest, AgreesWithSlabsAndQuadratics) {
    for (const CylinderCase& light : cylinder_cases()) {
        const auto cylinder = make_light<double>(light);
        const SolidCylinder wide = solid(cylinder);
        const Point s = wide.axis();
        std::mt19937_64 random(4);
        std::uniform_real_distribution<double> uniform(-1, 1);
        int hits = 0;
        for (int i = 0; i < 20'000; ++i) {
            const nusselt::Vec3<double> target =
                cylinder.axis.p0 + (uniform(random) * cylinder.axis.length) * cylinder.axis.s +
                (2 * cylinder.radius) *
                    nusselt::Vec3<double>{uniform(random), uniform(random), uniform(random)};
            const auto wi = normalize(target);
            const Point w = nusselt::broadcast<long double>(wi);
            // The distances r at which the part of r w + begin across the axis is as long as the radius, and those at
            // which the ray passes the planes of the caps.
            const Point across = w - dot(w, s) * s;
            const Point begin = wide.begin - dot(wide.begin, s) * s;
            const long double a = dot(across, across);
            const long double b = dot(across, begin);
            const long double root = b * b - a * (dot(begin, begin) - wide.radius * wide.radius);
            const long double plane0 = dot(wide.begin, s) / dot(w, s);
            const long double plane1 = dot(wide.end, s) / dot(w, s);
            const long double enters =
                std::max({(b - std::sqrt(std::max(root, 0.0L))) / a, std::min(plane0, plane1), 0.0L});
            const long double leaves =
                std::min((b + std::sqrt(std::max(root, 0.0L))) / a, std::max(plane0, plane1));
            if (std::fabs(root) < 1e-9L || std::fabs(leaves - enters) < 1e-9L) continue; // grazing
            const bool expected = root > 0 && leaves > enters;
            const auto found = intersect(cylinder, wi);
            EXPECT_EQ(static_cast<bool>(found.hits), expected) << light.name;
            if (!expected || !found.hits) continue;
            ++hits;
            EXPECT_NEAR(found.distance / enters, 1, 1e-11) << light.name;
        }
        EXPECT_GT(hits, 1000) << light.name;
    }
}

/// The integral over a half-plane starts like a square root where half-planes touch the cylinder. Rounding once decided how
/// large it is there: 1 % of the densities were off by 2e-5 and more.
TEST(CylinderSolidAngleTest, DensitiesDoNotFeelRoundingAtTheSilhouette) {
    constexpr int kCount = 10000;
    std::mt19937 engine(11);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<double> errors;
    for (int i = 0; i < kCount; ++i) {
        const float azimuth = 6.2831853f * uniform(engine);
        const float radius = 0.05f + 0.3f * uniform(engine), distance = radius + 0.5f + 2 * uniform(engine);
        const float length = 0.5f + 1.5f * uniform(engine);
        const nusselt::Vec3<float> start{distance * std::cos(azimuth), distance * std::sin(azimuth),
                                         -length * uniform(engine)};
        const nusselt::Cylinder<float> light{{start, {0, 0, 1}, length}, radius};
        const nusselt::Cylinder<long double> wide = nusselt::broadcast<long double>(light);
        const nusselt::CylinderSolidAngle<long double> exact(wide);
        const float u = uniform(engine), v = uniform(engine);
        const auto wi = nusselt::broadcast<float>(exact.sample({u, v}).wi);
        const long double density = exact.pdf(nusselt::broadcast<long double>(wi));
        errors.push_back(
            static_cast<double>(std::fabs(nusselt::CylinderSolidAngle<float>(light).pdf(wi) / density - 1)));
    }
    std::nth_element(errors.begin(), errors.end() - kCount / 100, errors.end());
    EXPECT_LT(errors[kCount - kCount / 100], 2e-6);
}

TEST(CylinderRejectionTest, EstimatesTheSolidAngleWithMisses) {
    for (const CylinderCase& light : cylinder_cases()) {
        const auto local = make_light<double>(light);
        const nusselt::CylinderRejectionGamito<double> technique(local);
        const long double expected = integrate_solid_angle(
            solid(local), [](const Point&) { return 1.0L; }, kQuadratureTolerance);
        constexpr int kCount = 400;
        long double sum = 0;
        for (const auto& u : midpoints<CylinderSolidAngleKind, double>(kCount)) {
            const auto sample = technique.sample(u);
            if (!(sample.pdf > 0)) continue;
            sum += 1 / sample.pdf;
            EXPECT_EQ(sample.pdf, technique.pdf(sample.wi));
        }
        // The tolerance allows for the midpoint rule on a discontinuous function.
        EXPECT_NEAR(sum / (kCount * kCount) / expected, 1, 2e-3) << light.name;
        EXPECT_GE(technique.measure(), expected) << light.name;
    }
}

} // namespace
} // namespace nusselt_test
