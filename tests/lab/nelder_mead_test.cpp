#include "lab/fuzzing/nelder_mead.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nusselt::lab {

namespace {

template <class Real, std::size_t N>
Box<Real, N> cube(Real half) {
    Box<Real, N> box;
    box.low.fill(-half);
    box.high.fill(half);
    return box;
}

template <class Real>
Real negative_rosenbrock(const Point<Real, 2>& p) {
    const Real across = p[1] - p[0] * p[0];
    return -(100 * across * across + (1 - p[0]) * (1 - p[0]));
}

template <class Real>
class NelderMeadTest : public testing::Test {};
using Scalars = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(NelderMeadTest, Scalars);

TYPED_TEST(NelderMeadTest, FindsTheEndOfTheRosenbrockValley) {
    using Real = TypeParam;
    const auto best =
        maximize<Real, 2>(negative_rosenbrock<Real>, cube<Real, 2>(5), {Real(-1.2L), 1}, 1, 400);
    // Near the maximum the function is -z^T H z / 2 plus rounding, and the small eigenvalue of H is 0.4: where
    // the simplex is flat up to eps, it is within sqrt(eps / 0.2). The factor of 4 is for steps of the simplex.
    const Real tolerance = 4 * std::sqrt(5 * std::numeric_limits<Real>::epsilon());
    EXPECT_NEAR(best.at[0], Real(1), tolerance);
    EXPECT_NEAR(best.at[1], Real(1), 2 * tolerance);
    EXPECT_EQ(best.value, negative_rosenbrock(best.at));
}

TYPED_TEST(NelderMeadTest, FindsCornersOfTheBoxExactly) {
    using Real = TypeParam;
    const auto slope = [](const Point<Real, 3>& p) { return p[0] - 2 * p[1] + 3 * p[2]; };
    const auto best = maximize<Real, 3>(slope, cube<Real, 3>(2), {}, 1, 200);
    EXPECT_EQ(best.at, (Point<Real, 3>{2, -2, 2}));
}

TYPED_TEST(NelderMeadTest, FindsMaximaOnFacesOfTheBox) {
    using Real = TypeParam;
    // Without the box the maximum would be at (3, 0.5, -1).
    const auto paraboloid = [](const Point<Real, 3>& p) {
        return -(p[0] - 3) * (p[0] - 3) - (p[1] - Real(0.5)) * (p[1] - Real(0.5)) - (p[2] + 1) * (p[2] + 1);
    };
    const auto best = maximize<Real, 3>(paraboloid, cube<Real, 3>(2), {1, -1, 1}, 1, 400);
    // The tolerance is derived as above, with a value of -1 and the eigenvalue 2.
    const Real tolerance = 4 * std::sqrt(std::numeric_limits<Real>::epsilon());
    EXPECT_EQ(best.at[0], Real(2));
    EXPECT_NEAR(best.at[1], Real(0.5), tolerance);
    EXPECT_NEAR(best.at[2], Real(-1), tolerance);
}

TEST(NelderMead, StaysOutOfForbiddenRegionsAndInTheBox) {
    const Box<long double, 2> box = cube<long double, 2>(3);
    bool inside = true;
    const auto in_disk = [&](const Point<long double, 2>& p) {
        inside = inside && p == box.nearest(p);
        const bool allowed = p[0] * p[0] + p[1] * p[1] <= 1;
        return allowed ? p[0] + p[1] : -std::numeric_limits<long double>::infinity();
    };
    const auto best = maximize<long double, 2>(in_disk, box, {0.2L, -0.3L}, 0.5L, 300);
    EXPECT_TRUE(inside);
    EXPECT_LE(best.value, std::sqrt(2.0L));
    // The simplex may get stuck at the boundary, but has climbed most of the way from -0.1.
    EXPECT_GT(best.value, 1.2L);
}

TEST(NelderMead, GoesInwardsFromTheUpperBounds) {
    const auto bowl = [](const Point<double, 2>& p) { return -p[0] * p[0] - p[1] * p[1]; };
    const auto best = maximize<double, 2>(bowl, cube<double, 2>(1), {1, 1}, 0.5, 200);
    EXPECT_NEAR(best.at[0], 0, 1e-6);
    EXPECT_NEAR(best.at[1], 0, 1e-6);
}

TEST(NelderMead, StopsWhereTheFunctionIsConstant) {
    int evaluations = 0;
    const auto constant = [&](const Point<double, 4>&) {
        ++evaluations;
        return 7.0;
    };
    const auto best = maximize<double, 4>(constant, cube<double, 4>(1), {}, 0.5, 1000000);
    EXPECT_EQ(best.value, 7);
    EXPECT_EQ(evaluations, 5);
}

TEST(NelderMead, NeverLosesTheStart) {
    const auto spike = [](const Point<double, 2>& p) { return p[0] == 0.25 && p[1] == 0 ? 1.0 : 0.0; };
    const auto best = maximize<double, 2>(spike, cube<double, 2>(1), {0.25, 0}, 0.5, 100);
    EXPECT_EQ(best.value, 1);
    EXPECT_EQ(best.at, (Point<double, 2>{0.25, 0}));
}

} // namespace

} // namespace nusselt::lab
