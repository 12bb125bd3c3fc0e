/// Tests of families of lines: chords, offsets and their densities.

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/line_samples/line_family.h>
#include <nusselt/simd/pack.h>

#include "line_samples/parts.h"
#include "random/random_statistics.h"

namespace nusselt_test {
namespace {

using nusselt::Chord;
using nusselt::ConvexPolygon;
using nusselt::Interval;
using nusselt::LineFamily;
using nusselt::Vec3;
using nusselt::test::chi_square_p_value;

/// The chord that a line cuts from a polygon, in long double, from the crossings with its edges.
template <class T, int N>
Interval<long double> exact_chord(const ConvexPolygon<T, N>& light, const nusselt::LinePlane<T>& plane,
                                  long double offset) {
    const auto exact = widened(plane);
    Point corner = {0, 0, 0};
    Interval<long double> chord{1e30L, -1e30L};
    for (int j = 0; j < N; ++j) {
        // The vertices are sums of edges, because edges define small lights that are far away.
        const Point next = j + 1 < N ? corner + to_point(light.edge[j]) : Point{0, 0, 0};
        const long double u0 = dot(corner, exact.across) - offset;
        const long double u1 = dot(next, exact.across) - offset;
        if ((u0 < 0) != (u1 < 0)) {
            const long double t = dot(corner + (u0 / (u0 - u1)) * (next - corner), exact.along);
            chord = {std::min(chord.begin, t), std::max(chord.end, t)};
        }
        corner = next;
    }
    return chord;
}

template <class T>
T extent_of(const ConvexPolygon<T, 8>& light) {
    T extent = 0;
    for (const auto& edge : light.edge) extent = std::max(extent, length(edge));
    return extent;
}

/// Angles of all kinds: random, along edges and close to edges.
double some_angle(RandomSource& random, int k) {
    if (k % 4 == 0) return 0;
    if (k % 4 == 1) return random.log_between(1e-9, 1e-5);
    return random.between(0, 3.14159);
}

template <class T>
void expect_chords_of_the_light(double distance, double size) {
    RandomSource random(1);
    constexpr T kRounding = 32 * std::numeric_limits<T>::epsilon();
    for (int k = 0; k < 2000; ++k) {
        const auto light = ellipse_polygon<T, 8>(random, 3 + k % 6, distance, size);
        const LineFamily<T, 8> family(light, static_cast<T>(some_angle(random, k)));
        const T extent = extent_of(light);
        for (int i = 0; i < 4; ++i) {
            const T offset = family.sample_uniform(static_cast<T>(random.uniform())).offset;
            const Interval<T> chord = family.chord(offset).extent;
            const Interval<long double> exact = exact_chord(light, family.plane(), offset);
            // Where an edge is nearly parallel to the lines, the end of the chord may slide along it.
            const Interval<long double> before =
                exact_chord(light, family.plane(), offset - kRounding * extent);
            const Interval<long double> after =
                exact_chord(light, family.plane(), offset + kRounding * extent);
            const auto within = [&](long double t, long double a, long double b, long double c) {
                return t >= std::min({a, b, c}) - kRounding * extent &&
                       t <= std::max({a, b, c}) + kRounding * extent;
            };
            EXPECT_TRUE(within(chord.begin, exact.begin, before.begin, after.begin)) << k;
            EXPECT_TRUE(within(chord.end, exact.end, before.end, after.end)) << k;
        }
    }
}

TEST(LineFamily, ChordsAreThoseOfTheLight) {
    expect_chords_of_the_light<double>(2, 1);
    expect_chords_of_the_light<float>(2, 1);
    expect_chords_of_the_light<float>(0.1, 1e6);
}

TEST(LineFamily, TinyLightsFarAwayKeepTheirShape) { expect_chords_of_the_light<float>(40, 1e-3); }

TEST(LineFamily, PlaneIsOrthonormal) {
    RandomSource random(2);
    for (int k = 0; k < 2000; ++k) {
        const auto light = ellipse_polygon<float, 8>(random, 3 + k % 6, 40, k % 2 == 0 ? 1e-3 : 10);
        const auto plane = LineFamily<float, 8>(light, static_cast<float>(some_angle(random, k))).plane();
        EXPECT_NEAR(length(plane.along), 1, 1e-6f);
        EXPECT_NEAR(length(plane.across), 1, 1e-6f);
        EXPECT_NEAR(dot(plane.along, plane.across), 0, 1e-6f);
        EXPECT_NEAR(dot(plane.along, plane.normal), 0, 1e-6f);
        // The errors of both lengths add up.
        EXPECT_NEAR(length(cross(plane.across, plane.along) - plane.normal), 0,
                    16 * std::numeric_limits<float>::epsilon());
    }
}

TEST(LineFamily, AngleIsThatWithTheLongestEdge) {
    const Vec3<double> corners[] = {{0, 0, 1}, {1, 0, 1}, {1, 3, 1}, {0, 3, 1}};
    const auto light = nusselt::make_polygon<4>(corners, 4);
    for (const double angle : {0.0, 0.3, 1.5707963, 3.0}) {
        const auto plane = LineFamily<double, 4>(light, angle).plane();
        EXPECT_NEAR(plane.along.y, std::cos(angle), 1e-15);
        EXPECT_NEAR(plane.along.x, -std::sin(angle), 1e-15);
    }
}

TEST(LineFamily, AreaIsThatOfTheLight) {
    RandomSource random(3);
    for (int k = 0; k < 2000; ++k) {
        const double size = k % 3 == 0 ? 1 : random.log_between(1e-12, 1e12);
        const auto light = ellipse_polygon<float, 8>(random, 3 + k % 6, size, size);
        const LineFamily<float, 8> family(light, static_cast<float>(some_angle(random, k)));
        const double area = static_cast<double>(0.5L * length(to_point(doubled_area_normal(light))));
        EXPECT_NEAR(family.area(), area, 2e-6 * area) << k;
    }
}

// The density of Sec. 5.1.2 is a tent over the projections of the vertices. The values here were computed by hand.
TEST(LineFamily, TrianglesHaveATent) {
    const Vec3<double> corners[] = {{0, 0, 0}, {4, 0, 0}, {1, 2, 0}};
    const LineFamily<double, 3> family(nusselt::make_polygon<3>(corners, 3), 1.5707963267948966);
    EXPECT_NEAR(family.area(), 4, 1e-14);
    const Interval<double> offsets = family.offsets();
    EXPECT_NEAR(offsets.end - offsets.begin, 4, 1e-14);
    EXPECT_NEAR(family.pdf_uniform(), 0.25, 1e-15);
    // Lines along y; across is +x or -x.
    const bool flipped = family.plane().across.x < 0;
    const double peak = flipped ? offsets.begin + 3 : offsets.begin + 1;
    EXPECT_NEAR(family.pdf_by_length(peak), 2.0 / 4, 1e-14);
    EXPECT_NEAR(family.pdf_by_length(peak - 0.25), flipped ? 0.5 * 2.75 / 3 : 0.5 * 0.75, 1e-14);
    EXPECT_NEAR(family.pdf_by_length(offsets.begin), 0, 1e-14);
    // The inverse of the distribution function on both sides of the peak.
    const double c = flipped ? 3 : 1;
    EXPECT_NEAR(family.sample_by_length(0.1).offset - offsets.begin, std::sqrt(0.1 * 4 * c), 1e-13);
    EXPECT_NEAR(offsets.end - family.sample_by_length(0.9).offset, std::sqrt(0.1 * 4 * (4 - c)), 1e-13);
}

TEST(LineFamily, DensitiesAreTheDerivativesOfTheInverses) {
    RandomSource random(4);
    for (int k = 0; k < 1000; ++k) {
        const auto light = ellipse_polygon<double, 8>(random, 3 + k % 6, 3, 1);
        const LineFamily<double, 8> family(light, random.between(0, 3.14159));
        const double step = 1e-6;
        const double u = random.between(2 * step, 1 - 2 * step);
        const auto by_length = family.sample_by_length(u);
        EXPECT_EQ(by_length.pdf, family.pdf_by_length(by_length.offset));
        const double slope =
            (family.sample_by_length(u + step).offset - family.sample_by_length(u - step).offset) /
            (2 * step);
        EXPECT_NEAR(by_length.pdf * slope, 1, 1e-3);
        EXPECT_NEAR(family.invert_by_length(by_length.offset), u, 1e-13);
        const auto uniform = family.sample_uniform(u);
        EXPECT_EQ(uniform.pdf, family.pdf_uniform());
        EXPECT_NEAR(uniform.pdf * (family.offsets().end - family.offsets().begin), 1, 1e-14);
        EXPECT_NEAR(family.invert_uniform(uniform.offset), u, 1e-13);
    }
}

TEST(LineFamily, ReachIsThatOfTheFarthestVertex) {
    RandomSource random(14);
    for (int k = 0; k < 500; ++k) {
        const auto light = ellipse_polygon<double, 8>(random, 3 + k % 6, 3, 1);
        const LineFamily<double, 8> family(light, random.between(0, 3.14159));
        double farthest = 0;
        for (const Vec3<double>& vertex : light.vertex) {
            const Vec3<double> p = vertex - family.plane().origin;
            farthest = std::max(
                {farthest, std::abs(dot(p, family.plane().across)), std::abs(dot(p, family.plane().along))});
        }
        EXPECT_NEAR(family.reach(), farthest, 1e-13 * farthest);
    }
}

TEST(LineFamily, OffsetsIncreaseWithTheRandomNumber) {
    RandomSource random(5);
    for (int k = 0; k < 300; ++k) {
        const auto light = ellipse_polygon<float, 8>(random, 3 + k % 6, 3, 1);
        const LineFamily<float, 8> family(light, static_cast<float>(some_angle(random, k)));
        float by_length = family.offsets().begin;
        float uniform = by_length;
        for (int i = 0; i <= 1000; ++i) {
            const float u = std::min(static_cast<float>(i) / 1000, 0x1.fffffep-1f);
            const float next = family.sample_by_length(u).offset;
            // At a knot, where two formulas meet, rounding may let the offset fall a little.
            EXPECT_GE(next, by_length - 1e-6f);
            EXPECT_LE(next, family.offsets().end);
            by_length = next;
            EXPECT_GE(family.sample_uniform(u).offset, uniform);
            uniform = family.sample_uniform(u).offset;
            EXPECT_LE(uniform, family.offsets().end);
        }
    }
}

/// p-value of the hypothesis that offsets follow a density over the offsets of a family.
double p_value_of_offsets(const LineFamily<double, 8>& family, const std::function<double(double)>& sample,
                          const std::function<double(double)>& pdf) {
    constexpr int kCells = 64;
    constexpr int kSamples = 200000;
    static const QuadratureRule rule = gauss_legendre(32);
    const Interval<double> all = family.offsets();
    const double width = (all.end - all.begin) / kCells;
    std::vector<int> counts(kCells);
    RandomSource random(11);
    for (int i = 0; i < kSamples; ++i) {
        const int cell = static_cast<int>((sample(random.uniform()) - all.begin) / width);
        ++counts[static_cast<std::size_t>(std::clamp(cell, 0, kCells - 1))];
    }
    double statistic = 0;
    for (int cell = 0; cell < kCells; ++cell) {
        double expected = 0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i)
            expected += static_cast<double>(rule.weights[i]) * width *
                        pdf(all.begin + width * (cell + static_cast<double>(rule.nodes[i])));
        const double difference = counts[static_cast<std::size_t>(cell)] - kSamples * expected;
        statistic += difference * difference / (kSamples * expected);
    }
    return chi_square_p_value(statistic, kCells - 1);
}

TEST(LineFamily, OffsetsFollowTheirDensities) {
    RandomSource random(6);
    const double level = nusselt::test::sidak_level(12);
    for (int vertices = 3; vertices <= 8; ++vertices) {
        const auto light = ellipse_polygon<double, 8>(random, vertices, 3, 1);
        const LineFamily<double, 8> family(light, random.between(0, 3.14159));
        const auto by_length = [&](double u) { return family.sample_by_length(u).offset; };
        const auto uniform = [&](double u) { return family.sample_uniform(u).offset; };
        const auto pdf_by_length = [&](double offset) { return family.pdf_by_length(offset); };
        const auto pdf_uniform = [&](double) { return family.pdf_uniform(); };
        EXPECT_GT(p_value_of_offsets(family, by_length, pdf_by_length), level) << vertices;
        EXPECT_GT(p_value_of_offsets(family, uniform, pdf_uniform), level) << vertices;
        // Mutants: the density of the other technique, and offsets that are a little too small.
        EXPECT_LT(p_value_of_offsets(family, uniform, pdf_by_length), level) << vertices;
        EXPECT_LT(p_value_of_offsets(family, by_length, pdf_uniform), level) << vertices;
        EXPECT_LT(p_value_of_offsets(
                      family, [&](double u) { return by_length(0.98 * u); }, pdf_by_length),
                  level)
            << vertices;
    }
}

TEST(LineFamily, PacksEqualScalars) {
    using Pack = nusselt::Pack<float, 8>;
    RandomSource random(7);
    for (int k = 0; k < 200; ++k) {
        const auto light = ellipse_polygon<float, 8>(random, 3 + k % 6, 3, 1);
        const LineFamily<float, 8> family(light, static_cast<float>(some_angle(random, k)));
        const LineFamily<Pack, 8> broadcast(family);
        Pack u{};
        for (int i = 0; i < 8; ++i) u.set_lane(i, static_cast<float>(random.between(0, 0.99999)));
        const auto choice = broadcast.sample_by_length(u);
        const auto uniform = broadcast.sample_uniform(u);
        const auto chord = broadcast.chord(choice.offset);
        const Pack inverse = broadcast.invert_by_length(choice.offset);
        for (int i = 0; i < 8; ++i) {
            const auto single = family.sample_by_length(u.lane(i));
            EXPECT_EQ(choice.offset.lane(i), single.offset);
            EXPECT_EQ(choice.pdf.lane(i), single.pdf);
            EXPECT_EQ(uniform.offset.lane(i), family.sample_uniform(u.lane(i)).offset);
            EXPECT_EQ(chord.extent.begin.lane(i), family.chord(single.offset).extent.begin);
            EXPECT_EQ(chord.extent.end.lane(i), family.chord(single.offset).extent.end);
            EXPECT_EQ(inverse.lane(i), family.invert_by_length(single.offset));
        }
    }
}

TEST(LineFamily, LightsWithoutAreaHaveNoLines) {
    const Vec3<float> point[] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
    const Vec3<float> line[] = {{0, 0, 1}, {1, 1, 1}, {2, 2, 1}, {1, 1, 1}};
    for (const auto* corners : {point, line}) {
        const LineFamily<float, 4> family(nusselt::make_polygon<4>(corners, 4), 0.7f);
        EXPECT_EQ(family.area(), 0);
        EXPECT_EQ(family.sample_by_length(0.3f).pdf, 0);
        EXPECT_EQ(family.sample_uniform(0.3f).pdf, 0);
        const Interval<float> chord = family.chord(family.sample_by_length(0.3f).offset).extent;
        EXPECT_TRUE(std::isfinite(chord.begin) && std::isfinite(chord.end));
    }
}

} // namespace
} // namespace nusselt_test
