/// Tests of polygons next to the shading point, in float. Most of the edges of their vertices are not floats.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/sampling/polygon_solid_angle.h>

#include "geometry/reference.h"
#include "proof/hostile/lights.h"

namespace nusselt_test {
namespace {

using nusselt::hostile::RandomSource;

/// An irregular polygon of diameter 1 at most.
/// \tparam N      number of vertices.
/// \param beside  distance of its centre from the foot of the perpendicular: up to 0.4 above the polygon, beyond 0.6
///                beside it.
/// \param height  of the origin above its plane.
template <int N>
std::vector<nusselt::Vec3<float>> close_polygon(RandomSource& random, double beside, double height) {
    const nusselt::Vec3<double> x = random.direction();
    const nusselt::Vec3<double> y = normalize(cross(x, random.direction()));
    const nusselt::Vec3<double> z = cross(x, y);
    const double first = random.between(0, 2 * std::numbers::pi);
    std::vector<nusselt::Vec3<float>> vertices;
    for (int j = 0; j < N; ++j) {
        const double angle = first + 2 * std::numbers::pi * (j + random.between(0, 0.3)) / N;
        const auto v = (beside + 0.5 * std::cos(angle)) * x + (0.5 * std::sin(angle)) * y + height * z;
        vertices.push_back(nusselt::broadcast<float>(v));
    }
    return vertices;
}

template <class Real, int N>
nusselt::ConvexPolygon<Real, N> polygon(const std::vector<nusselt::Vec3<float>>& vertices) {
    nusselt::Vec3<Real> v[N];
    for (int j = 0; j < N; ++j) v[j] = nusselt::broadcast<Real>(vertices[static_cast<std::size_t>(j)]);
    return nusselt::make_polygon<N>(v, N);
}

template <class Real, int N>
nusselt::PolygonSolidAngle<Real, N> technique(const std::vector<nusselt::Vec3<float>>& vertices) {
    return nusselt::PolygonSolidAngle<Real, N>(polygon<Real, N>(vertices));
}

double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

template <class Count>
class ClosePolygonsTest : public ::testing::Test {};

using Counts = ::testing::Types<std::integral_constant<int, 3>, std::integral_constant<int, 4>,
                                std::integral_constant<int, 5>, std::integral_constant<int, 6>,
                                std::integral_constant<int, 7>>;
TYPED_TEST_SUITE(ClosePolygonsTest, Counts);

/// A rounded normal gives errors of 3e-3 here.
TYPED_TEST(ClosePolygonsTest, SolidAnglesDoNotComeFromTheRoundedNormal) {
    constexpr int N = TypeParam::value;
    for (const bool above : {true, false}) {
        RandomSource random(N, above);
        std::vector<double> errors;
        for (int i = 0; i < 4000; ++i) {
            const double beside = above ? random.between(0, 0.25) : random.between(0.6, 1.6);
            const auto vertices = close_polygon<N>(random, beside, random.log_between(1e-5, 1e-3));
            Polygon exact;
            for (const auto& v : vertices) exact.push_back(nusselt::broadcast<long double>(v));
            const long double expected = girard(exact);
            if (expected < 1e-12L) continue;
            errors.push_back(
                std::fabs(static_cast<double>(technique<float, N>(vertices).measure() / expected - 1)));
        }
        // Above an edge, what remains are errors of directions, next to a jump from 0 to 2 pi.
        EXPECT_LT(quantile(errors, 0.5), 2e-7) << (above ? "above" : "beside");
        EXPECT_LT(quantile(errors, 0.99), 1e-5) << (above ? "above" : "beside");
    }
}

/// The vertices on the horizon are rounded once more, and the edge between them passes the origin at about the height of
/// the plane: errors are of the order of rounding over the height.
TYPED_TEST(ClosePolygonsTest, ClippedSolidAnglesHaveErrorsOfRoundingOverTheHeight) {
    constexpr int N = TypeParam::value;
    RandomSource random(N);
    std::vector<double> errors; // times the height
    while (errors.size() < 2000) {
        const double height = random.log_between(1e-5, 1e-3);
        const auto vertices = close_polygon<N>(random, random.between(0, 0.25), height);
        const auto is_above = [](const nusselt::Vec3<float>& v) { return v.z > 0; };
        if (std::all_of(vertices.begin(), vertices.end(), is_above) ||
            std::none_of(vertices.begin(), vertices.end(), is_above))
            continue;
        using Exact = nusselt::PolygonClippedSolidAngle<long double, N>;
        const long double expected = Exact(polygon<long double, N>(vertices)).measure();
        if (expected < 1e-2L) continue;
        const float measure =
            nusselt::PolygonClippedSolidAngle<float, N>(polygon<float, N>(vertices)).measure();
        errors.push_back(std::fabs(static_cast<double>(measure / expected - 1)) * height);
    }
    constexpr double kRounding = std::numeric_limits<float>::epsilon();
    EXPECT_LT(quantile(errors, 0.5), 0.1 * kRounding);
    EXPECT_LT(quantile(errors, 0.99), kRounding);
}

/// How far directions of lights that fill the hemisphere are from those in long double.
template <int N>
std::vector<double> turns(double lowest, double highest) {
    RandomSource random(N);
    std::vector<double> turns;
    for (int i = 0; i < 4000; ++i) {
        const double height = (i % 2 == 0 ? 1 : -1) * random.log_between(lowest, highest);
        const auto vertices = close_polygon<N>(random, random.between(0, 0.4), height);
        const nusselt::Vec2<float> u{static_cast<float>(random.between(0, 0.9999)),
                                     static_cast<float>(random.between(0, 0.9999))};
        const auto sample = technique<float, N>(vertices).sample(u);
        const auto expected = technique<long double, N>(vertices).sample(nusselt::broadcast<long double>(u));
        turns.push_back(
            static_cast<double>(length(nusselt::broadcast<long double>(sample.wi) - expected.wi)));
    }
    return turns;
}

/// Rounded directions to the vertices would turn samples by rounding over the height: 6e-4 at a height of 1e-4.
TYPED_TEST(ClosePolygonsTest, DirectionsFillTheHemisphereAsInLongDouble) {
    for (const double height : {1e-5, 1e-4, 1e-3}) {
        const auto errors = turns<TypeParam::value>(height, 10 * height);
        EXPECT_LT(quantile(errors, 0.5), 1e-6) << height;
        EXPECT_LT(quantile(errors, 0.99), 2e-5) << height;
        // Above an edge, corners of both sides meet. What is left is of the order of rounding over the height there.
        EXPECT_LT(quantile(errors, 1), std::numeric_limits<float>::epsilon() / height) << height;
    }
}

} // namespace
} // namespace nusselt_test
