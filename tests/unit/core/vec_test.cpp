/// Tests of numbers, vectors and frames.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <nusselt/core/frame.h>

#include "proof/hostile/lights.h"

namespace nusselt_test {

using nusselt::hostile::RandomSource;
namespace {

template <class T>
class VecTest : public ::testing::Test {
protected:
    using Vec = nusselt::Vec3<T>;
    static constexpr T kEpsilon = std::numeric_limits<T>::epsilon();

    static Vec random_vector(RandomSource& random) { return nusselt::broadcast<T>(random.direction()); }
};

using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(VecTest, Scalars);

TYPED_TEST(VecTest, DifferenceOfProductsDoesNotCancel) {
    using T = TypeParam;
    // (1 + e)^2 - (1 + 2e) * 1 = e^2. The difference of rounded products would be zero.
    const T e = this->kEpsilon;
    EXPECT_EQ(nusselt::difference_of_products(1 + e, 1 + e, 1 + 2 * e, T(1)), e * e);
}

TYPED_TEST(VecTest, CrossProductsHaveRelativePrecision) {
    using T = TypeParam;
    RandomSource random(1);
    for (int i = 0; i < 10'000; ++i) {
        const auto a = this->random_vector(random);
        const auto b = a + static_cast<T>(random.log_between(1e-6, 1)) * this->random_vector(random);
        const auto c = cross(a, b);
        if constexpr (sizeof(T) < sizeof(double)) {
            // Products of floats are exact in double.
            const auto exact = [](double p, double q, double r, double s) { return p * q - r * s; };
            const double x = exact(a.y, b.z, a.z, b.y);
            EXPECT_LE(std::fabs(c.x - x), 1.5 * this->kEpsilon * std::fabs(x));
        }
        // The cross product of a vector and the same vector times a power of two is exactly zero.
        EXPECT_EQ(length(cross(a, T(4) * a)), 0);
        EXPECT_LE(std::fabs(dot(a, c)), 4 * this->kEpsilon * length(c));
    }
}

/// What accumulating colours needs. All numbers are exact in every precision.
TYPED_TEST(VecTest, ScalarsStandOnEitherSideAndAssignmentsCombine) {
    using T = TypeParam;
    const auto expect = [](const nusselt::Vec3<T>& v, T x, T y, T z) {
        EXPECT_EQ(v.x, x);
        EXPECT_EQ(v.y, y);
        EXPECT_EQ(v.z, z);
    };
    const nusselt::Vec3<T> v{1, -2, 4}, w{3, 5, T(0.5)};
    expect(T(2) * v, 2, -4, 8);
    expect(v * T(2), 2, -4, 8);
    expect(v / T(2), T(0.5), -1, 2);
    nusselt::Vec3<T> sum = v;
    expect(sum += w, 4, 3, T(4.5));
    expect(sum -= v, 3, 5, T(0.5));
    expect(sum *= T(4), 12, 20, 2);
    expect(sum /= T(2), 6, 10, 1);
    expect(sum *= v, 6, -20, 4);
    expect(sum, 6, -20, 4);

    nusselt::Vec2<T> flat{1, -2};
    flat += nusselt::Vec2<T>{3, 7} * T(2);
    flat -= T(2) * nusselt::Vec2<T>{1, 1};
    (flat *= T(3)) /= T(5);
    EXPECT_EQ(flat.x, 3);
    EXPECT_EQ(flat.y, 6);
    const nusselt::Vec2<T> quotient = flat / T(2);
    EXPECT_EQ(quotient.x, T(1.5));
    EXPECT_EQ(quotient.y, 3);

    // One division per component, as in GLSL: a product with the reciprocal would round twice.
    const nusselt::Vec3<T> thirds = v / T(3);
    EXPECT_EQ(thirds.x, T(1) / T(3));
    EXPECT_EQ(thirds.z, T(4) / T(3));
}

TYPED_TEST(VecTest, LengthNeitherOverflowsNorUnderflows) {
    using T = TypeParam;
    constexpr T kLargest = std::numeric_limits<T>::max() / 8;
    constexpr T kSmallest = std::numeric_limits<T>::min();
    for (const T scale : {T(1), kLargest / 8, 8 * kSmallest}) {
        const nusselt::Vec3<T> v{2 * scale, -3 * scale, 6 * scale};
        EXPECT_NEAR(length(v) / scale, 7, 16 * this->kEpsilon);
        const auto unit = normalize(v);
        EXPECT_NEAR(unit.x, T(2) / 7, 2 * this->kEpsilon);
        EXPECT_NEAR(unit.y, T(-3) / 7, 2 * this->kEpsilon);
        EXPECT_NEAR(unit.z, T(6) / 7, 2 * this->kEpsilon);
    }
}

TYPED_TEST(VecTest, ZeroVectorStaysZero) {
    using T = TypeParam;
    const nusselt::Vec3<T> zero{0, 0, 0};
    EXPECT_EQ(length(zero), 0);
    EXPECT_EQ(normalize(zero).x, 0);
}

TYPED_TEST(VecTest, DenormalVectorsHaveDirections) {
    using T = TypeParam;
    const T tiny = std::numeric_limits<T>::denorm_min();
    EXPECT_EQ(normalize(nusselt::Vec3<T>{0, -tiny, 0}).y, -1);
}

TYPED_TEST(VecTest, FramesAreOrthonormalAndRightHanded) {
    using T = TypeParam;
    RandomSource random(2);
    const auto expect_frame = [&](const nusselt::Vec3<T>& normal) {
        const auto frame = nusselt::Frame<T>::from_normal(normal);
        const T tolerance = 4 * this->kEpsilon;
        EXPECT_NEAR(length(frame.t), 1, tolerance);
        EXPECT_NEAR(length(frame.b), 1, tolerance);
        EXPECT_NEAR(dot(frame.t, frame.b), 0, tolerance);
        EXPECT_NEAR(dot(frame.t, frame.n), 0, tolerance);
        EXPECT_NEAR(dot(frame.b, frame.n), 0, tolerance);
        EXPECT_LE(length(cross(frame.t, frame.b) - frame.n), tolerance);
        const auto v = this->random_vector(random);
        EXPECT_LE(length(frame.to_world(frame.to_local(v)) - v), 2 * tolerance);
        EXPECT_NEAR(frame.to_local(normal).z, 1, tolerance);
    };
    for (int i = 0; i < 10'000; ++i) expect_frame(normalize(this->random_vector(random)));
    expect_frame({0, 0, 1});
    expect_frame({0, 0, -1});
    expect_frame({1, 0, T(0)});
    expect_frame({1, 0, -T(0)});
    expect_frame(normalize(nusselt::Vec3<T>{T(1e-4), T(1e-5), T(-1)}));
}

TYPED_TEST(VecTest, ReciprocalPowersOfTwo) {
    using T = TypeParam;
    RandomSource random(3);
    for (int i = 0; i < 1000; ++i) {
        const T x = static_cast<T>(random.log_between(1e-30, 1e30));
        const T power = nusselt::reciprocal_power_of_two(x);
        int exponent = 0;
        EXPECT_EQ(std::frexp(power, &exponent), T(0.5));
        EXPECT_GE(power * x, T(1));
        EXPECT_LT(power * x, T(2));
        EXPECT_EQ(nusselt::reciprocal_power_of_two(power) * power, T(1));
    }
    for (const T x : {T(0), std::numeric_limits<T>::denorm_min(), std::numeric_limits<T>::max()}) {
        const T power = nusselt::reciprocal_power_of_two(x);
        EXPECT_TRUE(std::isnormal(power)) << x;
        EXPECT_TRUE(std::isnormal(1 / power)) << x;
    }
}

TYPED_TEST(VecTest, BelowOne) {
    using T = TypeParam;
    EXPECT_EQ(nusselt::below_one(T(0.5)), T(0.5));
    EXPECT_EQ(nusselt::below_one(T(-1)), 0);
    EXPECT_LT(nusselt::below_one(T(1)), 1);
    EXPECT_EQ(nusselt::below_one(std::numeric_limits<T>::infinity()), std::nextafter(T(1), T(0)));
    EXPECT_EQ(nusselt::below_one(std::numeric_limits<T>::quiet_NaN()), 0);
}

TYPED_TEST(VecTest, MaximumAndMinimumTakeTheSecondOperandIfInDoubt) {
    using T = TypeParam;
    const T nan = std::numeric_limits<T>::quiet_NaN();
    EXPECT_EQ(nusselt::max(nan, T(1)), 1);
    EXPECT_EQ(nusselt::min(nan, T(1)), 1);
    EXPECT_TRUE(std::isnan(nusselt::max(T(1), nan)));
    EXPECT_FALSE(std::signbit(nusselt::max(-T(0), T(0))));
    EXPECT_TRUE(std::signbit(nusselt::min(T(0), -T(0))));
    EXPECT_FALSE(nusselt::is_finite(nan));
    EXPECT_FALSE(nusselt::is_finite(-std::numeric_limits<T>::infinity()));
    EXPECT_TRUE(nusselt::is_finite(std::numeric_limits<T>::max()));
}

} // namespace
} // namespace nusselt_test
