/// Tests of core/trig.h: its documented error bounds hold on dense grids, and packs have the bits of scalars.

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include <nusselt/core/trig.h>
#include <nusselt/simd/pack.h>

namespace nusselt_test {
namespace {

constexpr long double kPi = 3.141592653589793238462643383279502884L;

struct Largest {
    long double error = 0;
    float at = 0;
    void add(long double candidate, float argument) {
        if (candidate > error) error = candidate, at = argument;
    }
};

/// Calls f with the sides of right triangles. The angles cover [0, pi]; they are dense at tiny angles and near
/// multiples of pi / 8, where the formulas change.
template <class Function>
void for_each_direction(const Function& f) {
    for (int i = 1; i < 400'000; ++i) {
        const long double angle = kPi * i / 400'000;
        f(static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)));
    }
    for (int k = 0; k <= 8; ++k) {
        for (int i = -2000; i <= 2000; ++i) {
            const long double angle = k * kPi / 8 + i * 1e-7L;
            f(std::max(static_cast<float>(std::sin(angle)), 0.0f), static_cast<float>(std::cos(angle)));
        }
    }
    for (float tiny = 1e-37f; tiny < 1; tiny *= 1.37f) {
        f(tiny, 1);
        f(1, tiny);
        f(1, -tiny);
        f(tiny, -1);
        f(1e38f * tiny, 1e30f);
    }
}

TEST(TrigTest, ArctangentIsPreciseInFloat) {
    Largest relative;
    for_each_direction([&](float y, float x) {
        const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        const long double error = std::fabs(nusselt::atan2_positive(y, x) - exact);
        if (exact > 0) relative.add(error / exact, y / x);
    });
    EXPECT_LE(relative.error, 3e-7L) << "at the tangent " << relative.at;
    EXPECT_GT(relative.error, 1e-8L);
}

TEST(TrigTest, FastArctangentHasTheDocumentedError) {
    Largest absolute;
    for_each_direction([&](float y, float x) {
        const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        absolute.add(std::fabs(nusselt::atan2_positive_fast(y, x) - exact), y / x);
        absolute.add(std::fabs(nusselt::atan2_positive_fast(double{y}, double{x}) - exact), y / x);
    });
    EXPECT_LE(absolute.error, 1.3e-5L) << "at the tangent " << absolute.at;
    EXPECT_GT(absolute.error, 1e-6L);
}

template <class T>
class ArctangentTest : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(ArctangentTest, Scalars);

TYPED_TEST(ArctangentTest, SpecialArguments) {
    using T = TypeParam;
    const T pi = nusselt::kPi<T>;
    EXPECT_EQ(nusselt::atan2_positive(T(0), T(0)), 0);
    EXPECT_EQ(nusselt::atan2_positive(T(0), T(1)), 0);
    EXPECT_EQ(nusselt::atan2_positive(T(0), T(-1)), pi);
    EXPECT_EQ(nusselt::atan2_positive(T(-1), T(1)), 0);
    EXPECT_EQ(nusselt::atan2_positive(T(-1), T(-1)), pi);
    EXPECT_EQ(nusselt::atan2_positive(std::numeric_limits<T>::quiet_NaN(), T(1)), 0);
    EXPECT_NEAR(nusselt::atan2_positive(T(1), T(0)), pi / 2, std::numeric_limits<T>::epsilon());
}

TEST(TrigTest, SineAndCosineArePreciseInFloat) {
    Largest relative_sine, absolute_sine, absolute_cosine;
    for (int i = 0; i <= 2'000'000; ++i) {
        const auto angle = std::min(static_cast<float>(kPi * i / 2'000'000), nusselt::kPi<float>);
        const auto [sine, cosine] = nusselt::sincos_half_turn(angle);
        const long double exact_sine = std::sin(static_cast<long double>(angle));
        const long double error = std::fabs(sine - exact_sine);
        if (kPi - angle > 1e-4L) {
            if (angle > 0) relative_sine.add(error / exact_sine, angle);
        } else {
            absolute_sine.add(error, angle);
        }
        absolute_cosine.add(std::fabs(cosine - std::cos(static_cast<long double>(angle))), angle);
    }
    EXPECT_LE(relative_sine.error, 2e-7L) << "at " << relative_sine.at;
    EXPECT_LE(absolute_sine.error, 2e-7L) << "at " << absolute_sine.at;
    EXPECT_LE(absolute_cosine.error, 1.2e-7L) << "at " << absolute_cosine.at;
}

TEST(TrigTest, SineAndCosineOfTheQuarterTurnArePreciseInFloat) {
    Largest relative_sine, absolute_cosine;
    for (int i = 1; i <= 1'000'000; ++i) {
        const auto angle = std::min(static_cast<float>(kPi / 2 * i / 1'000'000), nusselt::kPi<float> / 2);
        const auto [sine, cosine] = nusselt::sincos_quarter_turn(angle);
        const long double exact = std::sin(static_cast<long double>(angle));
        relative_sine.add(std::fabs(sine - exact) / exact, angle);
        absolute_cosine.add(std::fabs(cosine - std::cos(static_cast<long double>(angle))), angle);
    }
    EXPECT_LE(relative_sine.error, 1.5e-7L) << "at " << relative_sine.at;
    EXPECT_LE(absolute_cosine.error, 1.2e-7L) << "at " << absolute_cosine.at;
}

TEST(TrigTest, ArctangentsUpToOneArePreciseInFloat) {
    Largest arctangent, relative, absolute;
    for (int i = 1; i <= 1'000'000; ++i) {
        const float q = static_cast<float>(i) / 1'000'000;
        const long double exact = std::atan(static_cast<long double>(q));
        arctangent.add(std::fabs(nusselt::atan_up_to_one(q) / exact - 1), q);
        const long double t = std::sqrt(static_cast<long double>(q));
        // The difference cancels for small t; there the first terms of the series are exact enough.
        const long double ratio =
            t > 0.02L ? 1 - std::atan(t) / t : t * t * (1 / 3.0L - t * t / 5 + t * t * t * t / 7);
        const float actual = nusselt::one_minus_atan_ratio(q);
        relative.add(std::fabs(actual / ratio - 1), q);
        absolute.add(std::fabs(actual - ratio), q);
    }
    EXPECT_LE(arctangent.error, 3e-7L) << "at " << arctangent.at;
    EXPECT_LE(relative.error, 1.1e-6L) << "at " << relative.at;
    EXPECT_LE(absolute.error, 5e-8L) << "at " << absolute.at;
}

TEST(TrigTest, DividedDifferencesOfTheArctangentKeepTheirPrecision) {
    Largest relative;
    for (int i = 0; i <= 1000; ++i) {
        const float s = static_cast<float>(i) / 1000;
        for (float step = 1e-12f; s + step <= 1; step *= 3) {
            const auto [value, difference] = nusselt::one_minus_atan_ratio_difference(s, step);
            EXPECT_EQ(value, nusselt::one_minus_atan_ratio(s));
            // The derivative of the exact function at the midpoint; the third derivative adds at most step^2.
            const long double middle = std::max(s + step / 2.0L, 1e-9L);
            const long double t = std::sqrt(middle);
            const long double slope = t < 0.02L ? 1 / 3.0L - 2 * middle / 5 + 3 * middle * middle / 7
                                                : (std::atan(t) / t - 1 / (1 + middle)) / (2 * middle);
            if (step < 1e-3f) relative.add(std::fabs(difference / (step * slope) - 1), s);
        }
    }
    EXPECT_LE(relative.error, 1e-4L) << "at " << relative.at;
}

TYPED_TEST(ArctangentTest, AngleMinusSineKeepsItsPrecision) {
    using T = TypeParam;
    for (T t = T(1e-6); t <= 1; t = t < 1 ? std::min(t * T(1.01), T(1)) : T(2)) {
        const long double wide = 2 * std::atan(static_cast<long double>(t));
        long double term = wide * wide * wide / 6;
        long double series = 0;
        for (int k = 1; k < 30; ++k) {
            series += term;
            term *= -wide * wide / ((2 * k + 2) * (2 * k + 3));
        }
        // One rounding for each of the products around the polynomial, and more for the polynomial itself, whose terms
        // cancel where t is large: 6e-7 in float.
        const long double bound = 5 * static_cast<long double>(std::numeric_limits<T>::epsilon());
        EXPECT_LE(std::fabs(nusselt::angle_minus_sine(t) / series - 1), bound) << t;
        EXPECT_EQ(nusselt::angle_minus_sine(-t), -nusselt::angle_minus_sine(t));
    }
}

template <class Packed>
class PackTrigTest : public ::testing::Test {};
using Packs = ::testing::Types<nusselt::Pack<float, nusselt::kNativeLanes<float>>,
                               nusselt::Pack<double, nusselt::kNativeLanes<double>>>;
TYPED_TEST_SUITE(PackTrigTest, Packs);

template <class T>
bool same_bits(T a, T b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

TYPED_TEST(PackTrigTest, LanesEqualScalars) {
    using T = nusselt::scalar_t<TypeParam>;
    constexpr int kLanes = nusselt::RealTraits<TypeParam>::kLanes;
    for (int round = 0; round < 2000; ++round) {
        TypeParam y(T(0)), x(T(0)), angle(T(0));
        for (int i = 0; i < kLanes; ++i) {
            const T turn =
                nusselt::kPi<T> * static_cast<T>(round * kLanes + i) / static_cast<T>(2000 * kLanes);
            angle.set_lane(i, turn);
            y.set_lane(i, std::sin(turn) * static_cast<T>(1 + i));
            x.set_lane(i, std::cos(turn));
        }
        const TypeParam arctangent = nusselt::atan2_positive(y, x);
        const TypeParam fast = nusselt::atan2_positive_fast(y, x);
        const auto [sine, cosine] = nusselt::sincos_half_turn(angle);
        const TypeParam share = TypeParam(1 / nusselt::kPi<T>) * angle;
        const TypeParam difference = nusselt::angle_minus_sine(share);
        for (int i = 0; i < kLanes; ++i) {
            EXPECT_PRED2(same_bits<T>, arctangent.lane(i), nusselt::atan2_positive(y.lane(i), x.lane(i)));
            EXPECT_PRED2(same_bits<T>, fast.lane(i), nusselt::atan2_positive_fast(y.lane(i), x.lane(i)));
            const auto scalar = nusselt::sincos_half_turn(angle.lane(i));
            EXPECT_PRED2(same_bits<T>, sine.lane(i), scalar.sin);
            EXPECT_PRED2(same_bits<T>, cosine.lane(i), scalar.cos);
            EXPECT_PRED2(same_bits<T>, difference.lane(i), nusselt::angle_minus_sine(share.lane(i)));
        }
    }
}

} // namespace
} // namespace nusselt_test
