/// Tests of the interpolation in tables of linearly transformed cosines: samples, borders of cells, ends of axes, and
/// packs.

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/ltc/table.h>
#include <nusselt/simd/pack.h>

namespace {

using nusselt::kNativeLanes;
using nusselt::kPi;
using nusselt::LtcCoefficients;
using nusselt::LtcTableView;
using nusselt::Pack;
using nusselt::scalar_t;
using nusselt::Vec3;

constexpr int kStride = LtcTableView::kStride;
constexpr int kRoughnesses = 5, kInclinations = 7, kF0s = 4;

/// Fills a table with random positive entries, so that no two cells are alike. The albedo is linear in f0.
class LtcTableTest : public testing::Test {
protected:
    LtcTableTest() {
        std::mt19937 engine(1);
        std::uniform_real_distribution<float> value(0.05f, 1.0f);
        for (int cell = 0; cell < kRoughnesses * kInclinations; ++cell) {
            const float black = 0.5f * value(engine), white = value(engine);
            for (int f = 0; f < kF0s; ++f) {
                for (int k = 0; k + 1 < kStride; ++k) entries_.push_back(value(engine));
                const float t = static_cast<float>(f) / (kF0s - 1);
                entries_.push_back((1 - t) * black + t * white);
            }
        }
    }

    LtcTableView view() const { return {entries_.data(), kRoughnesses, kInclinations, kF0s}; }

    const float* sample(int r, int i, int f) const {
        return &entries_[static_cast<std::size_t>(((r * kInclinations + i) * kF0s + f) * kStride)];
    }

private:
    std::vector<float> entries_;
};

template <class Real>
std::vector<double> numbers_of(const LtcCoefficients<Real>& c) {
    std::vector<double> numbers;
    for (const Real x : {c.m00, c.m02, Real(1) / c.m11, -c.m20, c.m22, c.albedo})
        numbers.push_back(static_cast<double>(x));
    return numbers;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::fabs(a[k] - b[k]));
    return largest;
}

double cos_of(double inclination_over_right_angle) {
    return std::cos(kPi<double> / 2 * inclination_over_right_angle);
}

TEST_F(LtcTableTest, ReturnsItsSamples) {
    for (int r = 0; r < kRoughnesses; ++r)
        for (int i = 0; i < kInclinations; ++i)
            for (int f = 0; f < kF0s; ++f) {
                const auto found =
                    view().lookup(double(r) / (kRoughnesses - 1), cos_of(double(i) / (kInclinations - 1)),
                                  double(f) / (kF0s - 1));
                const float* expected = sample(r, i, f);
                EXPECT_LT(largest_difference(numbers_of(found), {expected, expected + kStride}), 1e-12);
            }
}

TEST_F(LtcTableTest, AveragesInTheMiddleOfACell) {
    std::vector<double> mean(kStride, 0.0);
    for (int corner = 0; corner < 8; ++corner)
        for (int k = 0; k < kStride; ++k)
            mean[static_cast<std::size_t>(k)] +=
                static_cast<double>(sample(2 + (corner & 1), 4 + (corner >> 1 & 1), 1 + (corner >> 2))[k]) /
                8;
    const auto found =
        view().lookup(2.5 / (kRoughnesses - 1), cos_of(4.5 / (kInclinations - 1)), 1.5 / (kF0s - 1));
    EXPECT_LT(largest_difference(numbers_of(found), mean), 1e-12);
}

TEST_F(LtcTableTest, HasNoSeams) {
    std::mt19937 engine(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    constexpr double kStep = 1e-9;
    for (int axis = 0; axis < 3; ++axis) {
        const int samples[] = {kRoughnesses, kInclinations, kF0s};
        for (int border = 0; border < samples[axis]; ++border)
            for (int repetition = 0; repetition < 20; ++repetition) {
                double at[3] = {uniform(engine), uniform(engine), uniform(engine)};
                std::vector<double> sides[2];
                for (int side = 0; side < 2; ++side) {
                    at[axis] = double(border) / (samples[axis] - 1) + (side == 0 ? -kStep : kStep);
                    sides[side] = numbers_of(view().lookup(at[0], cos_of(at[1]), at[2]));
                }
                EXPECT_LT(largest_difference(sides[0], sides[1]), 100 * kStep) << axis << " " << border;
            }
    }
}

TEST_F(LtcTableTest, SharesAnAlbedoWithColouredReflectance) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int repetition = 0; repetition < 100; ++repetition) {
        const double roughness = uniform(engine), cos_o = uniform(engine);
        const Vec3<double> f0{uniform(engine), uniform(engine), repetition % 2 == 0 ? 0.0 : 1.0};
        const Vec3<double> albedo = view().albedo(roughness, cos_o, f0);
        EXPECT_NEAR(albedo.x, view().lookup(roughness, cos_o, f0.x).albedo, 1e-7);
        EXPECT_NEAR(albedo.y, view().lookup(roughness, cos_o, f0.y).albedo, 1e-7);
        EXPECT_NEAR(albedo.z, view().lookup(roughness, cos_o, f0.z).albedo, 1e-7);
    }
}

template <class Real>
class LtcTablePackTest : public LtcTableTest {};
using Packs =
    testing::Types<Pack<float, kNativeLanes<float>>, Pack<double, kNativeLanes<double>>, Pack<float, 16>>;
TYPED_TEST_SUITE(LtcTablePackTest, Packs);

/// Includes arguments beyond the ends of the axes, and NaN.
TYPED_TEST(LtcTablePackTest, LanesAgreeWithScalars) {
    using Real = TypeParam;
    using Scalar = scalar_t<Real>;
    constexpr int kLanes = nusselt::RealTraits<Real>::kLanes;
    constexpr Scalar kHostile[] = {0,
                                   1,
                                   -1,
                                   2,
                                   std::numeric_limits<Scalar>::infinity(),
                                   -std::numeric_limits<Scalar>::infinity(),
                                   std::numeric_limits<Scalar>::quiet_NaN(),
                                   std::numeric_limits<Scalar>::denorm_min()};
    std::mt19937 engine(4);
    std::uniform_real_distribution<Scalar> uniform(0, 1);
    const auto number = [&] { return engine() % 3 == 0 ? kHostile[engine() % 8] : uniform(engine); };
    for (int repetition = 0; repetition < 200; ++repetition) {
        Scalar arguments[3][kLanes];
        for (auto& row : arguments)
            for (Scalar& x : row) x = number();
        const auto roughness = Real::load(arguments[0]), cos_o = Real::load(arguments[1]),
                   f0 = Real::load(arguments[2]);
        const auto found = this->view().lookup(roughness, cos_o, f0);
        const auto albedo = this->view().albedo(roughness, cos_o, Vec3<Real>{f0, roughness, cos_o});
        for (int i = 0; i < kLanes; ++i) {
            const Scalar r = arguments[0][i], c = arguments[1][i], f = arguments[2][i];
            const auto expected = this->view().lookup(r, c, f);
            const LtcCoefficients<Scalar> lane{found.m00.lane(i), found.m02.lane(i), found.m11.lane(i),
                                               found.m20.lane(i), found.m22.lane(i), found.albedo.lane(i)};
            EXPECT_EQ(numbers_of(lane), numbers_of(expected)) << r << " " << c << " " << f;
            EXPECT_EQ(albedo.y.lane(i), this->view().albedo(r, c, Vec3<Scalar>{f, r, c}).y);
            EXPECT_GT(lane.m11 * (lane.m00 * lane.m22 - lane.m02 * lane.m20), 0);
            EXPECT_TRUE(std::isfinite(lane.m11));
        }
    }
}

TEST_F(LtcTableTest, ClampsWhatIsBeyondTheEnds) {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const auto expect = [&](float r, float c, float f, const float* expected) {
        EXPECT_LT(largest_difference(numbers_of(view().lookup(r, c, f)), {expected, expected + kStride}),
                  1e-6);
    };
    expect(-1, 2, -inf, sample(0, 0, 0));
    expect(inf, -1, 7, sample(kRoughnesses - 1, kInclinations - 1, kF0s - 1));
    expect(nan, nan, nan, sample(0, kInclinations - 1, 0));
}

} // namespace
