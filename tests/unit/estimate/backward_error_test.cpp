/// The errors that iterative techniques would have in exact arithmetic, as far as long double can show them. The
/// bounds are those of the papers and of the doc comments.

#include <nusselt/estimate/backward_error.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/reference.h"
#include "proof/hostile/lights.h"
#include "sampling/techniques.h"

namespace nusselt_test {
namespace {

using Real = long double;
using PolygonLight = nusselt::ConvexPolygon<Real, 4>;
using LineLight = nusselt::LineSegment<Real>;
template <int Iterations>
using PolygonTechnique = nusselt::PolygonProjectedSolidAngle<Real, 4, Iterations>;
template <int Iterations>
using LineTechnique = nusselt::LineProjectedSolidAngle<Real, Iterations>;

/// Draws many random numbers close to 0 and 1, where errors are largest.
Real hard_random_number(RandomSource& random) {
    const double tail = random.log_between(1e-7, 0.5);
    return random.index(2) == 0 ? tail : 1 - tail;
}

/// A planar triangle or quadrilateral of any orientation with its center at distance 1. The horizon often cuts it.
PolygonLight random_polygon(RandomSource& random) {
    const auto widen = [](const nusselt::Vec3<double>& v) { return nusselt::broadcast<Real>(v); };
    const Point center = widen(random.direction());
    const Point a = widen(random.direction());
    const Point b = normalize(cross(a, widen(random.direction())));
    const Real size = random.log_between(0.1, 30);
    const int count = 3 + random.index(2);
    const Real start = random.between(0, 6.3);
    Point v[4] = {};
    for (int j = 0; j < count; ++j) {
        const Real angle = start + 2 * kPi * (static_cast<Real>(j) + Real(0.8) * random.uniform()) / count;
        v[j] = center + (size * std::cos(angle)) * a + (size * std::sin(angle)) * b;
    }
    return nusselt::make_polygon<4>(v, count);
}

LineLight random_line(RandomSource& random) {
    const Real half = random.log_between(0.05, 100);
    const Point middle = nusselt::broadcast<Real>(random.direction());
    const Point direction = nusselt::broadcast<Real>(random.direction());
    return nusselt::make_line(middle - half * direction, middle + half * direction);
}

/// Projected solid angle of the part of a polygon above the horizon whose azimuths lie between those of a and b,
/// counterclockwise from a. They are at most half a turn apart.
Real within(const Polygon& polygon, const Point& a, const Point& b) {
    return lambert(cut(cut(polygon, {-a.y, a.x, 0}), {b.y, -b.x, 0}));
}

/// The first random number of a direction, from first principles: cuts the polygon by the half-plane through the z
/// axis and the direction, and applies Lambert's formula.
Real azimuth_fraction(const PolygonLight& light, const Point& wi) {
    const Polygon polygon = above_horizon(vertices_of(light));
    const bool counterclockwise = dot(light.normal, light.vertex[0]) >= 0;
    // Azimuths count from the first vertex after clipping if the zenith is in the light, otherwise from the vertex at
    // which the light starts.
    Point begin = polygon.front();
    Real smallest = 1;
    Real inside = 1;
    for (std::size_t j = 0; j < polygon.size(); ++j) {
        const Point& next = polygon[(j + 1) % polygon.size()];
        const Real turn = polygon[j].x * next.y - polygon[j].y * next.x;
        inside = std::min(inside, counterclockwise ? turn : -turn);
    }
    if (inside < 0) {
        for (const Point& v : polygon) {
            Real worst = 1;
            for (const Point& other : polygon) {
                const Real turn = v.x * other.y - v.y * other.x;
                worst = std::min(worst, counterclockwise ? turn : -turn);
            }
            if (smallest == 1 || worst > smallest) {
                begin = v;
                smallest = worst;
            }
        }
    } else {
        begin = nusselt::clip_to_horizon(light).vertex[0];
    }
    const Real total = lambert(polygon);
    const auto turn = begin.x * wi.y - begin.y * wi.x;
    const Real ahead = counterclockwise ? turn : -turn;
    const Real to_wi = counterclockwise ? within(polygon, begin, wi) : within(polygon, wi, begin);
    const Real from_wi = counterclockwise ? within(polygon, wi, begin) : within(polygon, begin, wi);
    return ahead >= 0 ? to_wi / total : 1 - from_wi / total;
}

TEST(BackwardErrorTest, InversionOfPolygonsAgreesWithCuttingThem) {
    RandomSource random(1);
    int compared = 0;
    while (compared < 3000) {
        const PolygonLight light = random_polygon(random);
        const PolygonTechnique<3> technique(light);
        const nusselt::Vec2<Real> u{random.between(1e-4, 1 - 1e-4), random.between(0.01, 0.99)};
        if (technique.measure() < 1e-2L) continue;
        const Point wi = technique.sample(u).wi;
        EXPECT_NEAR(technique.invert(wi).x, azimuth_fraction(light, wi), 1e-12L);
        ++compared;
    }
}

TEST(BackwardErrorTest, InversionOfLinesAgreesWithQuadrature) {
    RandomSource random(2);
    int compared = 0;
    while (compared < 300) {
        LineLight light = random_line(random);
        if (light.length > 4 || light.p0.z < 0 || widened_end(light).z < 0) continue;
        const LineTechnique<4> technique(light);
        const auto sample = technique.sample(static_cast<Real>(random.uniform()));
        const auto integrand = [&](const Point& p) {
            const Real r = length(p);
            return 2 * length(cross(p, light.s)) * p.z / (r * r * r * r);
        };
        const Real part = integrate(widened_begin(light), sample.p, integrand);
        EXPECT_NEAR(technique.invert(sample.wi), part / technique.measure(), 1e-9L);
        ++compared;
    }
}

/// Backward errors for many random lights, sorted.
class Errors {
public:
    void add(Real error) { errors_.push_back(error); }
    int count() const { return static_cast<int>(errors_.size()); }
    Real largest() const { return *std::max_element(errors_.begin(), errors_.end()); }
    /// The error that a given fraction of the cases does not exceed.
    Real quantile(double fraction) {
        std::sort(errors_.begin(), errors_.end());
        return errors_[static_cast<std::size_t>(fraction * count())];
    }

private:
    std::vector<Real> errors_;
};

template <int Iterations, class RandomNumber>
Errors polygon_errors(int count, const RandomNumber& random_number) {
    RandomSource random(3);
    Errors errors;
    while (errors.count() < count) {
        const PolygonTechnique<Iterations> technique(random_polygon(random));
        const nusselt::Vec2<Real> u{random_number(random), random.between(0.01, 0.99)};
        if (technique.measure() < 1e-2L) continue;
        const Real error = nusselt::backward_error(technique, u, technique.sample(u).wi);
        errors.add(std::min(error, 1 - error)); // cyclic where the zenith is in the light
    }
    return errors;
}

template <int Iterations>
Errors line_errors(int count) {
    RandomSource random(4);
    Errors errors;
    while (errors.count() < count) {
        const LineTechnique<Iterations> technique(random_line(random));
        const Real u = hard_random_number(random);
        if (!(technique.measure() > 0)) continue;
        errors.add(nusselt::backward_error(technique, u, technique.sample(u).wi));
    }
    return errors;
}

TEST(BackwardErrorTest, WorstCasesOfPolygons) {
    EXPECT_LE(polygon_errors<2>(100'000, hard_random_number).largest(), 4e-5L);
    // One iteration does not reach the bound.
    EXPECT_GT(polygon_errors<1>(10'000, hard_random_number).largest(), 4e-5L);
}

TEST(BackwardErrorTest, PolygonsConvergeWithOrderThree) {
    const auto uniform = [](RandomSource& random) -> Real { return random.uniform(); };
    Errors start = polygon_errors<0>(10'000, uniform);
    Errors one = polygon_errors<1>(10'000, uniform);
    Errors two = polygon_errors<2>(10'000, uniform);
    EXPECT_LE(start.largest(), 0.28L);
    EXPECT_LE(start.quantile(0.99), 0.1L);
    EXPECT_GT(start.largest(), 0.05L);
    // Each step triples the logarithm of the error, up to a constant factor.
    constexpr double kQuantile = 0.9;
    EXPECT_GT(std::log(one.quantile(kQuantile)) / std::log(start.quantile(kQuantile)), 2.5L);
    EXPECT_GT(std::log(two.quantile(kQuantile)) / std::log(one.quantile(kQuantile)), 2.5L);
}

TEST(BackwardErrorTest, WorstCasesOfLines) {
    EXPECT_GT(line_errors<0>(10'000).largest(), 0.01L);
    EXPECT_LE(line_errors<1>(100'000).largest(), 4.7e-4L);
    EXPECT_LE(line_errors<2>(100'000).largest(), 9.3e-7L);
    // Three steps reach rounding, here relative to an angle of 1e-3.
    EXPECT_LE(line_errors<3>(20'000).largest(), 1e4L * std::numeric_limits<Real>::epsilon());
    // With one step fewer, the bounds do not hold.
    EXPECT_GT(line_errors<1>(10'000).largest(), 9.3e-7L);
    EXPECT_GT(line_errors<2>(10'000).largest(), 1e4L * std::numeric_limits<Real>::epsilon());
}

/// A trapezoid with two vertical edges. It consists of a single sector, and every sector can be represented this way.
PolygonLight wall(Real azimuth_range, Real inner_begin, Real inner_end, Real outer_begin, Real outer_end) {
    const Real x = std::cos(azimuth_range);
    const Real y = std::sin(azimuth_range);
    const Point corners[4] = {{1, 0, outer_begin}, {x, y, outer_end}, {x, y, inner_end}, {1, 0, inner_begin}};
    return nusselt::make_polygon<4>(corners, 4);
}

// The largest errors that `nusselt-lab bench worst-case` has found, and their lights. They are properties of the
// methods: double precision gives the same first ten digits as the 64 bits of x87 (rounding is 1e-16 relative to the
// random number, 1e-11 relative to the error), so the five digits below hold for any long double.
constexpr Real kRelativeTolerance = 1e-5L;

template <int Iterations>
void expect_polygon_error(const PolygonLight& light, Real u, Real measure, Real error) {
    const PolygonTechnique<Iterations> technique(light);
    EXPECT_NEAR(technique.measure(), measure, 1e-3L * measure);
    const nusselt::Vec2<Real> random_number{u, 0.5L};
    const Point wi = technique.sample(random_number).wi;
    EXPECT_NEAR(nusselt::backward_error(technique, random_number, wi), error, kRelativeTolerance * error);
    EXPECT_NEAR(std::fabs(azimuth_fraction(light, wi) - u), error, kRelativeTolerance * error);
}

TEST(WorstCaseTest, PolygonWhereBothGreatCirclesMeetOnTheHorizon) {
    const PolygonLight light = wall(0x8.2449b5a3e06cee5p-2L, 0xb.51625cb0a07279p+2L, 0xd.863d5d0c8c03d64p-26L,
                                    0xd.d84085eb2d3475ap+1L, 0x8.8239ce5565cd1aep-26L);
    const Real u = 0xf.ffd6b393acd7c48p-4L;
    expect_polygon_error<2>(light, u, 1e-2L, 1.96926e-5L);
    expect_polygon_error<3>(light, u, 1e-2L, 3.59709e-7L);
}

TEST(WorstCaseTest, PolygonOfTinyArea) {
    const PolygonLight light =
        wall(0xa.c78458f2c2955b2p-2L, 0x9.2bcdaff757c912bp-18L, 0x9.9f23aca7c140135p+3L,
             0x9.b30a387c9dbb42cp-49L, 0x9.9f23aca7b354869p+3L);
    expect_polygon_error<2>(light, 0x8.884d2b7e7e01df2p-4L, 1e-7L, 7.28885e-5L);
}

TEST(WorstCaseTest, PolygonWithoutIteration) {
    const PolygonLight light = wall(0xa.7ac8ec9340d09bep-2L, 0xa.49183e32433f3f8p-2L, 0x8.9b8b544716136c8p-7L,
                                    0xa.4917eb5d6b5ca77p-2L, 0xa.7f457621045a819p-29L);
    expect_polygon_error<0>(light, 0x8.7d663432b7d7b0ap-4L, 1e-2L, 2.71758e-1L);
}

TEST(WorstCaseTest, LineFromTheHorizonToItsAxis) {
    // Angles count from the direction to the closest point, which is tilted against the normal.
    const Real tilt = 0xc.84072038440b2bcp-2L;
    const Real begin = 0xc.7710964e71ba0b9p-3L;
    const Real end = 0xc.90fd23ea58a448cp-3L;
    const Real u = 0x8.1ce96712da93e88p-14L;
    const Point s{std::cos(tilt), 0, std::sin(tilt)};
    const Point t{-s.z, 0, s.x};
    const LineTechnique<2> technique(LineLight{std::tan(begin) * s + t, s, std::tan(end) - std::tan(begin)});
    const Point wi = technique.sample(u).wi;
    constexpr Real kError = 9.28767e-7L;
    EXPECT_NEAR(nusselt::backward_error(technique, u, wi), kError, kRelativeTolerance * kError);
    // The integral of the paper. The line starts on the horizon.
    const auto integral = [&](Real angle) {
        const Real sine = std::sin(angle);
        return s.z * sine * sine + t.z * (sine * std::cos(angle) + angle);
    };
    const Real part = integral(std::atan2(dot(wi, s), dot(wi, t))) - integral(begin);
    EXPECT_NEAR(std::fabs(part / (integral(end) - integral(begin)) - u), kError, kRelativeTolerance * kError);
}

} // namespace
} // namespace nusselt_test
