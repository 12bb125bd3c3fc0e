/// Warps to polynomial densities on the unit interval and the unit square (related/hart_warps.h).

#include <nusselt/related/hart_warps.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace nusselt {

namespace {

template <class Real>
class HartWarpsTest : public ::testing::Test {
protected:
    static constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();
    static constexpr Real kLargest = 1 - kEpsilon / 2;

    /// Zero, ordinary, small or tiny.
    Real value() {
        const double kind = uniform_(generator_);
        const double magnitude =
            std::pow(10.0, kind < 0.75 ? -8 * uniform_(generator_) : -30 * uniform_(generator_));
        return kind < 0.25 ? Real(0) : static_cast<Real>(kind < 0.5 ? uniform_(generator_) : magnitude);
    }

    /// Also close to both ends.
    Real random_number() {
        const double kind = uniform_(generator_);
        if (kind < 0.5) return below_one(static_cast<Real>(uniform_(generator_)));
        const auto small = static_cast<Real>(std::pow(10.0, -20 * uniform_(generator_)));
        return below_one(kind < 0.75 ? small : 1 - small);
    }

private:
    std::mt19937 generator_{11};
    std::uniform_real_distribution<double> uniform_{0, 1};
};

using Reals = ::testing::Types<float, double, long double>;
struct RealNames {
    template <class Real>
    static const char* GetName(int) {
        return std::is_same_v<Real, float>    ? "float"
               : std::is_same_v<Real, double> ? "double"
                                              : "long_double";
    }
};
TYPED_TEST_SUITE(HartWarpsTest, Reals, RealNames);

/// The distribution function of a quadratic density with control values, in the expanded form.
long double quadratic_distribution(long double p, long double q, long double r, long double x) {
    return x * (p + x * ((q - p) + x * ((p - 2 * q + r) / 3))) * 3 / (p + q + r);
}

TYPED_TEST(HartWarpsTest, InvertsDistributions) {
    using Real = TypeParam;
    const Real budget = 8 * this->kEpsilon;
    for (int i = 0; i < 300000; ++i) {
        const Real p = this->value(), q = this->value(), r = this->value(), u = this->random_number();
        const hart::LinearWarp<Real> linear(p, r);
        const Real x = linear.sample(u);
        ASSERT_TRUE(x >= 0 && x < 1);
        ASSERT_LE(std::fabs(linear.invert(x) - u), budget) << p << " " << r;
        const hart::QuadraticWarp<Real> quadratic(p, q, r);
        const Real y = quadratic.sample(u);
        ASSERT_TRUE(y >= 0 && y < 1);
        ASSERT_LE(std::fabs(quadratic.invert(y) - u), budget) << p << " " << q << " " << r;
        if (p + q + r > 0) {
            // Rounding of y moves the distribution function by at most three roundings of 1.
            const long double expected = quadratic_distribution(p, q, r, y);
            ASSERT_LE(std::fabs(expected - u), budget) << p << " " << q << " " << r;
        }
    }
}

TYPED_TEST(HartWarpsTest, AreAccurateForSmallRandomNumbers) {
    using Real = TypeParam;
    for (int i = 0; i < 100000; ++i) {
        const Real q = this->value(), r = this->value();
        if (!(q + r > Real(1e-20))) continue;
        const Real u = Real(0.1) * this->random_number();
        const Real x = hart::QuadraticWarp<Real>(Real(0), q, r).sample(u);
        const long double expected = quadratic_distribution(0, q, r, x);
        if (u > Real(1e-7)) {
            ASSERT_LE(std::fabs(expected / u - 1), 16 * this->kEpsilon) << q << " " << r << " " << u;
        }
    }
}

TYPED_TEST(HartWarpsTest, AreMonotone) {
    using Real = TypeParam;
    for (int i = 0; i < 200; ++i) {
        const hart::LinearWarp<Real> linear(this->value(), this->value());
        const hart::QuadraticWarp<Real> quadratic(this->value(), this->value(), this->value());
        Real last_linear = 0, last_quadratic = 0;
        for (int k = 0; k < 200; ++k) {
            const Real u = static_cast<Real>(k) / 200;
            const Real x = linear.sample(u), y = quadratic.sample(u);
            ASSERT_LE(last_linear, x);
            ASSERT_LE(last_quadratic, y);
            last_linear = x;
            last_quadratic = y;
        }
    }
}

/// The mean of a function over midpoints of the unit square.
template <class Real, class Function>
Real mean_of(const Function& f) {
    constexpr int kCount = 64;
    Real sum = 0;
    for (int i = 0; i < kCount; ++i)
        for (int j = 0; j < kCount; ++j)
            sum +=
                f((static_cast<Real>(i) + Real(0.5)) / kCount, (static_cast<Real>(j) + Real(0.5)) / kCount);
    return sum / (kCount * kCount);
}

TYPED_TEST(HartWarpsTest, DensitiesHaveMeanOne) {
    using Real = TypeParam;
    // Midpoints miss a quadratic function by 1 / 24 of its second derivative over the squared count.
    const Real budget = Real(1e-3);
    for (int i = 0; i < 50; ++i) {
        const Real a = this->value(), b = this->value(), c = this->value(), d = this->value(),
                   e = this->value();
        const hart::LinearWarp<Real> linear(a, b);
        EXPECT_LE(std::fabs((mean_of<Real>([&](Real x, Real) { return linear.density(x); })) - 1), budget);
        const hart::QuadraticWarp<Real> quadratic(a, b, c);
        EXPECT_LE(std::fabs((mean_of<Real>([&](Real x, Real) { return quadratic.density(x); })) - 1), budget);
        const hart::BilinearWarp<Real> bilinear({a, b, c});
        EXPECT_LE(std::fabs((mean_of<Real>([&](Real x, Real y) {
                                return bilinear.density({x, y});
                            })) -
                            1),
                  budget);
        const hart::BiquadraticWarp<Real> biquadratic(a, {b, c, d}, {e, a, c});
        EXPECT_LE(std::fabs((mean_of<Real>([&](Real x, Real y) {
                                return biquadratic.density({x, y});
                            })) -
                            1),
                  budget);
    }
}

/// The largest deviation from 1 of the density times the area to which a warp maps a small square.
template <class Warp>
double square_error(const Warp& warp) {
    constexpr double kStep = 1e-5;
    double worst = 0;
    for (const double x : {0.1, 0.35, 0.5, 0.77, 0.95}) {
        for (const double y : {0.1, 0.35, 0.5, 0.77, 0.95}) {
            const auto across = warp.sample({x + kStep, y}) - warp.sample({x - kStep, y});
            const auto along = warp.sample({x, y + kStep}) - warp.sample({x, y - kStep});
            const double area = (across.x * along.y - across.y * along.x) / (4 * kStep * kStep);
            worst = std::max(worst, std::fabs(area * warp.density(warp.sample({x, y})) - 1));
        }
    }
    return worst;
}

/// Takes the average of the conditional densities for all of them.
struct WithoutConditional : hart::BilinearWarp<double> {
    explicit WithoutConditional(const hart::FanCorners<double>& c)
        : hart::BilinearWarp<double>(c),
          y(2 * c.apex, c.first + c.last),
          x(c.apex + c.first, c.apex + c.last) {}
    Vec2<double> sample(const Vec2<double>& u) const { return {x.sample(u.x), y.sample(u.y)}; }
    hart::LinearWarp<double> y, x;
};
/// Takes values of the middle for values half-way, as if the density interpolated them.
struct WithOtherValues : hart::BiquadraticWarp<double> {
    WithOtherValues(double apex, const Vec3<double>& middle, const Vec3<double>& end)
        : hart::BiquadraticWarp<double>(apex, middle, end), other(apex, 0.5 * (middle + end), end) {}
    Vec2<double> sample(const Vec2<double>& u) const { return other.sample(u); }
    hart::BiquadraticWarp<double> other;
};

TEST(HartWarps, SamplesOfTheSquareHaveTheirDensity) {
    const Vec3<double> middle{0.3, 0.9, 0.2}, end{0.1, 0.5, 0.8};
    EXPECT_LE(square_error(hart::BilinearWarp<double>({0.2, 0.9, 0.1})), 1e-7);
    EXPECT_LE(square_error(hart::BilinearWarp<double>({0, 0.9, 0})), 1e-7);
    EXPECT_LE(square_error(hart::BiquadraticWarp<double>(0.4, middle, end)), 1e-7);
    EXPECT_LE(square_error(hart::BiquadraticWarp<double>(0, {0, 1, 0}, {0, 0, 1})), 1e-6);
    // Mutants.
    EXPECT_GE(square_error(WithoutConditional({0.2, 0.9, 0.1})), 0.1);
    EXPECT_GE(square_error(WithOtherValues(0.4, middle, end)), 0.1);
}

TYPED_TEST(HartWarpsTest, InvertsSamplesOfTheSquare) {
    using Real = TypeParam;
    for (int i = 0; i < 20000; ++i) {
        const Real a = this->value(), b = this->value(), c = this->value(), d = this->value();
        const Vec2<Real> u{this->random_number(), this->random_number()};
        const auto expect = [&](const auto& warp) {
            const Vec2<Real> x = warp.sample(u);
            ASSERT_TRUE(x.x >= 0 && x.x < 1 && x.y >= 0 && x.y < 1);
            ASSERT_GE(warp.density(x), 0);
            const Vec2<Real> inverse = warp.invert(x);
            ASSERT_LE(std::fabs(inverse.x - u.x), 8 * this->kEpsilon);
            ASSERT_LE(std::fabs(inverse.y - u.y), 8 * this->kEpsilon);
        };
        expect(hart::BilinearWarp<Real>({a, b, c}));
        expect(hart::BiquadraticWarp<Real>(a, {b, c, d}, {d, a, b}));
    }
}

TYPED_TEST(HartWarpsTest, WithoutValuesAreTheIdentity) {
    using Real = TypeParam;
    const Real zero = 0, denormal = std::numeric_limits<Real>::denorm_min();
    for (const Real none : {zero, denormal}) {
        for (const Real u : {Real(0), Real(0.25), Real(0.6), this->kLargest}) {
            const Real tolerance = 4 * this->kEpsilon;
            const Vec2<Real> pair{u, 1 - u / 2 - this->kEpsilon};
            EXPECT_LE(std::fabs(hart::LinearWarp<Real>(none, none).sample(u) - u), tolerance);
            EXPECT_LE(std::fabs(hart::QuadraticWarp<Real>(none, none, none).sample(u) - u), tolerance);
            const hart::BilinearWarp<Real> bilinear({none, none, none});
            EXPECT_EQ(bilinear.density(pair), 1);
            EXPECT_LE(std::fabs(bilinear.sample(pair).x - pair.x), tolerance);
            EXPECT_LE(std::fabs(bilinear.sample(pair).y - pair.y), tolerance);
            const hart::BiquadraticWarp<Real> biquadratic(none, {none, none, none}, {none, none, none});
            EXPECT_LE(std::fabs(biquadratic.density(pair) - 1), tolerance);
            EXPECT_LE(std::fabs(biquadratic.sample(pair).x - pair.x), tolerance);
            EXPECT_LE(std::fabs(biquadratic.sample(pair).y - pair.y), tolerance);
        }
    }
}

TYPED_TEST(HartWarpsTest, QuadraticOnesOfLinearValuesAreLinear) {
    using Real = TypeParam;
    for (const auto& [a, b] :
         {Vec2<Real>{0, 1}, {1, 0}, {1, 1}, {Real(0.2), Real(0.9)}, {1, 1 + this->kEpsilon}}) {
        const hart::LinearWarp<Real> linear(a, b);
        const hart::QuadraticWarp<Real> quadratic(a, (a + b) / 2, b);
        for (int i = 0; i <= 100; ++i) {
            const Real u = below_one(static_cast<Real>(i) / 100);
            EXPECT_LE(std::fabs(linear.sample(u) - quadratic.sample(u)), 8 * this->kEpsilon);
            EXPECT_LE(std::fabs(linear.density(u) - quadratic.density(u)), 8 * this->kEpsilon);
        }
    }
}

TEST(HartWarps, KnownValues) {
    // Densities 2 x, 3 x^2 and 6 x (1 - x).
    EXPECT_DOUBLE_EQ((hart::LinearWarp<double>(0, 1).sample(0.25)), 0.5);
    EXPECT_NEAR((hart::QuadraticWarp<double>(0, 0, 1).sample(0.125)), 0.5, 1e-15);
    EXPECT_NEAR((hart::QuadraticWarp<double>(0, 0, 1).sample(1e-12)), 1e-4, 1e-16);
    EXPECT_NEAR((hart::QuadraticWarp<double>(1, 0, 0).sample(0.875)), 0.5, 1e-15);
    EXPECT_NEAR((hart::QuadraticWarp<double>(0, 1, 0).sample(0.5)), 0.5, 1e-15);
    EXPECT_NEAR((hart::QuadraticWarp<double>(0, 1, 0).sample(0.028)), 0.1, 1e-15);
    // u = 0 where the density vanishes.
    EXPECT_EQ((hart::LinearWarp<float>(0, 1).sample(0)), 0);
    EXPECT_EQ((hart::QuadraticWarp<float>(0, 0, 1).sample(0)), 0);
    EXPECT_EQ((hart::BilinearWarp<float>({0, 1, 1}).density({0.5f, 0})), 0);
}

} // namespace

} // namespace nusselt
