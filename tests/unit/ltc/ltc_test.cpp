/// Tests of lobes: their density, their linear map and the frame in which they are defined.

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "geometry/adaptive_quadrature.h"
#include "lobes.h"
#include "reference.h"
#include "sampling/contract.h"
#include "sampling/lights.h"

#include <nusselt/ltc/ltc.h>

namespace nusselt_test {
namespace {

using nusselt::Ltc;

template <class T>
class LtcTest : public ::testing::Test {};

/// Excludes long double, in which the references are no more accurate than the library.
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(LtcTest, Scalars);

template <class T>
nusselt::Vec3<T> random_direction(std::mt19937& engine) {
    std::normal_distribution<double> normal;
    const double x = normal(engine);
    const double y = normal(engine);
    return normalize(nusselt::Vec3<T>{static_cast<T>(x), static_cast<T>(y), static_cast<T>(normal(engine))});
}

/// Directions everywhere, and many close to the peak of a lobe.
template <class T>
std::vector<nusselt::Vec3<T>> directions(const Ltc<T>& ltc) {
    std::mt19937 engine(1);
    std::vector<nusselt::Vec3<T>> result = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                            {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    for (int i = 0; i < 500; ++i) {
        result.push_back(random_direction<T>(engine));
        result.push_back(normalize(ltc.to_shading(random_direction<T>(engine))));
    }
    return result;
}

/// The bound holds for every lobe, since nothing cancels.
TYPED_TEST(LtcTest, DensityIsThatOfTheTextbookUpToRounding) {
    using T = TypeParam;
    for (const NamedLobe& lobe : all_lobes()) {
        const auto coefficients = rounded<T>(lobe.coefficients);
        const ReferenceLobe reference(coefficients);
        const Ltc<T> ltc(coefficients);
        for (const auto& wi : directions(ltc)) {
            const long double expected = reference.density(nusselt::broadcast<long double>(wi));
            const long double error = std::fabs(static_cast<long double>(ltc.density(wi)) - expected);
            EXPECT_LE(error, 16 * std::numeric_limits<T>::epsilon() * expected) << lobe.name;
        }
    }
}

TYPED_TEST(LtcTest, DensityIntegratesToOne) {
    using T = TypeParam;
    constexpr long double kTolerance = sizeof(T) == 4 ? 1e-6L : 1e-13L;
    constexpr double kBudget = sizeof(T) == 4 ? 1e-5 : 1e-12;
    for (const NamedLobe& lobe : all_lobes()) {
        const auto coefficients = rounded<T>(lobe.coefficients);
        const Ltc<T> ltc(coefficients);
        // The lobe is zero beyond its horizon, so polar coordinates about the normal of that plane cover it.
        const Point axis = ReferenceLobe(coefficients).horizon();
        const auto frame = nusselt::Frame<long double>::from_normal(normalize(axis));
        const long double width = length(axis) / std::hypot(coefficients.m00, coefficients.m02);
        const auto density = [&](long double x, long double y) {
            // Half of the square covers the angles up to the width of the lobe.
            const long double theta = std::atan2(width * x, 1 - x);
            const long double slope = width / ((1 - x) * (1 - x) + width * width * x * x);
            const long double phi = y * 2 * kPi;
            const Point wi = frame.to_world(
                {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
            return 2 * kPi * slope * std::sin(theta) *
                   static_cast<long double>(ltc.density(nusselt::broadcast<T>(wi)));
        };
        EXPECT_NEAR(static_cast<double>(integrate_square(density, kTolerance)), 1, kBudget) << lobe.name;
        for (const auto& wi : directions(ltc)) {
            if (dot(frame.n, nusselt::broadcast<long double>(wi)) >= -1e-6L) continue;
            EXPECT_EQ(ltc.density(wi), 0) << lobe.name;
        }
    }
}

TYPED_TEST(LtcTest, MapsVectorsToCosineSpaceAndBack) {
    using T = TypeParam;
    for (const NamedLobe& lobe : all_lobes()) {
        const Ltc<T> ltc(rounded<T>(lobe.coefficients));
        EXPECT_GT(ltc.minor(), 0);
        for (const auto& v : directions(ltc)) {
            // In cosine space, narrow lobes leave little of the component along their axis.
            const auto there_and_back = (1 / ltc.minor()) * ltc.to_shading(ltc.to_cosine(v));
            const T budget = 16 * std::numeric_limits<T>::epsilon();
            EXPECT_LE(length(there_and_back - v), budget) << lobe.name;
            // The image of a plane through v is a plane through the image of v.
            const auto n = cross(v, nusselt::Vec3<T>{T(0.3), T(-0.5), T(0.8)});
            const auto image = ltc.normal_to_cosine(n);
            const auto o = ltc.to_cosine(v);
            const T terms = std::fabs(image.x * o.x) + std::fabs(image.y * o.y) + std::fabs(image.z * o.z);
            EXPECT_LE(std::fabs(dot(image, o)), budget * (terms + ltc.minor())) << lobe.name;
        }
    }
}

TYPED_TEST(LtcTest, ScaleOfTheMatrixMeansNothing) {
    using T = TypeParam;
    for (const NamedLobe& lobe : all_lobes()) {
        auto c = rounded<T>(lobe.coefficients);
        const Ltc<T> ltc(c);
        for (T* entry : {&c.m00, &c.m02, &c.m11, &c.m20, &c.m22}) *entry *= T(0x1p-30);
        const Ltc<T> scaled(c);
        for (const auto& wi : directions(ltc)) EXPECT_EQ(ltc.density(wi), scaled.density(wi));
    }
}

TYPED_TEST(LtcTest, FramePutsTheEyeIntoTheXzHalfPlane) {
    using T = TypeParam;
    constexpr T kBudget = 8 * std::numeric_limits<T>::epsilon();
    std::mt19937 engine(2);
    for (int i = 0; i < 3000; ++i) {
        const auto normal = random_direction<T>(engine);
        auto wo = random_direction<T>(engine);
        if (i % 5 == 1) wo = normal;
        if (i % 5 == 2) wo = -normal;
        // The eye is almost parallel to the normal, down to a difference of one rounding.
        const T offset = std::pow(T(10), -T(i % 20) / 2);
        if (i % 5 == 3) wo = normalize(normal + offset * wo);
        const auto frame = nusselt::shading_frame(normal, wo);
        for (const auto* axis : {&frame.t, &frame.b}) {
            EXPECT_NEAR(static_cast<double>(length(*axis)), 1, static_cast<double>(kBudget));
            EXPECT_LE(std::fabs(dot(*axis, normal)), kBudget);
        }
        EXPECT_LE(length(cross(frame.t, frame.b) - normal), kBudget);
        const auto local = frame.to_local(wo);
        EXPECT_LE(std::fabs(local.y), kBudget);
        EXPECT_GE(local.x, -kBudget);
    }
}

TEST(LtcPacksTest, LanesAreScalars) {
    const auto lobes = all_lobes();
    constexpr int kLanes = nusselt::RealTraits<NativeFloat>::kLanes;
    std::mt19937 engine(3);
    for (int round = 0; round < 200; ++round) {
        nusselt::LtcCoefficients<NativeFloat> packed;
        nusselt::Vec3<NativeFloat> wi;
        nusselt::LtcCoefficients<float> lobe[kLanes];
        nusselt::Vec3<float> direction[kLanes];
        for (int i = 0; i < kLanes; ++i) {
            lobe[i] = rounded<float>(lobes[static_cast<std::size_t>(round + i) % lobes.size()].coefficients);
            direction[i] = random_direction<float>(engine);
            set_lane<float>(packed, i, lobe[i]);
            set_lane<float>(wi, i, direction[i]);
        }
        const NativeFloat density = Ltc<NativeFloat>(packed).density(wi);
        for (int i = 0; i < kLanes; ++i) {
            EXPECT_EQ((get_lane<float, float>(density, i)), Ltc<float>(lobe[i]).density(direction[i]));
        }
    }
}

} // namespace
} // namespace nusselt_test
