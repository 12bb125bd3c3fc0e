/// Tests of sampling of lines whose radiance depends on the direction: nodes, densities, weights, noise, hostile lights.

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/line_emission/line_nodes.h>
#include <nusselt/line_emission/textured_line.h>

namespace nusselt_test {
namespace {

using nusselt::LineNodes;
using nusselt::LineProjectedSolidAngle;
using nusselt::LineSegment;
using nusselt::make_line;
using nusselt::make_line_nodes;
using nusselt::ProjectedLines;
using nusselt::TexturedLine;
using nusselt::Vec3;

template <class T>
using Nodes = LineNodes<T, 32>;
template <class T>
using Technique = TexturedLine<T, 32, ProjectedLines<T>, Nodes<T>>;

/// A beam around an axis, and a little of everything else.
template <class T>
struct Beam {
    Vec3<T> axis;
    T exponent;

    Vec3<T> operator()(const Vec3<T>& wi) const {
        const T cosine = std::max(dot(axis, wi), T(0));
        const T value = std::pow(cosine, exponent) + T(0.02);
        return {value, value, value};
    }
};

std::vector<LineSegment<double>> lines() {
    return {make_line(Vec3<double>{-0.5, 0.3, 1}, {0.5, 0.4, 1.2}),
            make_line(Vec3<double>{-3, 0.2, 0.1}, {4, 0.1, 0.3}),
            make_line(Vec3<double>{1, -0.4, -0.7}, {0.8, 0.9, 1.1}),
            make_line(Vec3<double>{30, -70, 200}, {31, -69, 200.3})};
}

std::vector<Beam<double>> beams() {
    return {{normalize(Vec3<double>{0.2, 0.3, 1}), 8},
            {normalize(Vec3<double>{-0.6, 0.1, 0.7}), 60},
            {{0, 0, 1}, 0}};
}

/// Solid angle per radius and share of the length, in the limit of a thin cylinder.
double solid_angle_density(const LineSegment<double>& line, double at) {
    const Vec3<double> p = fma(at * line.length, line.s, line.p0);
    const double squared = dot(p, p);
    return 2 * line.length * length(cross(p, line.s)) / (squared * std::sqrt(squared));
}

template <class Function>
double mean_over(int steps, const Function& f) {
    double sum = 0;
    for (int k = 0; k < steps; ++k) sum += f((k + 0.5) / steps);
    return sum / steps;
}

TEST(LineNodes, HaveEqualAnglesAndFollowTheRadiance) {
    for (const LineSegment<double>& line : lines()) {
        const Beam<double> beam = beams()[0];
        const auto nodes = make_line_nodes(line, 0.0, beam);
        const auto direction = [&](int k) {
            return normalize(fma(nodes.border[k] * line.length, line.s, line.p0));
        };
        const double step = std::acos(dot(direction(0), direction(1)));
        EXPECT_EQ(nodes.border[0], 0);
        EXPECT_EQ(nodes.border[32], 1);
        for (int k = 0; k < 32; ++k) {
            EXPECT_LT(nodes.border[k], nodes.border[k + 1]);
            EXPECT_NEAR(std::acos(std::min(dot(direction(k), direction(k + 1)), 1.0)), step, 1e-6);
            EXPECT_NEAR(nodes.radiance[0][k], beam(direction(k)).x, 1e-12);
            EXPECT_EQ(nodes.cell_at(nodes.border[k]), k);
            EXPECT_EQ(nodes.cell_at(0.5 * (nodes.border[k] + nodes.border[k + 1])), k);
        }
        EXPECT_EQ(nodes.cell_at(1), 31);
    }
}

TEST(LineNodes, DensityIntegratesToOneAndEstimatesAreRight) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const LineSegment<double>& line : lines()) {
        for (const Beam<double>& beam : beams()) {
            const auto nodes = make_line_nodes(line, 0.0, beam);
            const Technique<double> technique(line, nodes);
            const LineProjectedSolidAngle<double> plain(line);
            EXPECT_NEAR(
                mean_over(8192,
                          [&](double at) { return technique.pdf_at(at) * solid_angle_density(line, at); }),
                1, 2e-3);
            const double expected = mean_over(200000, [&](double at) {
                const Vec3<double> wi = normalize(fma(at * line.length, line.s, line.p0));
                return beam(wi).x * std::max(wi.z, 0.0) * solid_angle_density(line, at);
            });
            double sum = 0, squares = 0, of_plain = 0, mutant = 0;
            constexpr int kCount = 20000;
            for (int i = 0; i < kCount; ++i) {
                const auto s = technique.sample(uniform(random));
                ASSERT_GT(s.pdf, 0);
                EXPECT_NEAR(technique.pdf(s.wi) / s.pdf, 1, 1e-6);
                const double value = beam(s.wi).x * s.wi.z / s.pdf;
                sum += value;
                squares += value * value;
                // The mutant forgets the density of the cell.
                mutant += beam(s.wi).x * s.wi.z / plain.pdf(s.wi);
                const auto p = plain.sample(uniform(random));
                of_plain += std::pow(beam(p.wi).x * p.wi.z / p.pdf, 2);
            }
            const double mean = sum / kCount;
            const double deviation = std::sqrt(std::max(squares / kCount - mean * mean, 0.0));
            const double plain_deviation = std::sqrt(std::max(of_plain / kCount - expected * expected, 0.0));
            std::printf("noise %.5f, of the technique that does not know the beam %.5f\n", deviation / mean,
                        plain_deviation / mean);
            EXPECT_NEAR(mean, expected, 1e-5 * expected + 5 * deviation / std::sqrt(double{kCount}));
            if (beam.exponent > 0 && plain_deviation > 0.1 * mean) {
                EXPECT_LT(deviation, 0.1 * plain_deviation);
                EXPECT_GT(std::fabs(mutant / kCount - expected), 0.01 * expected);
            }
        }
    }
}

/// A beam between two nodes is found, though rarely.
TEST(LineNodes, MissNoBeam) {
    const LineSegment<double> line = make_line(Vec3<double>{-1, 0, 1}, {1, 0, 1});
    const Vec3<double> axis = normalize(Vec3<double>{0.024, 0, 1});
    const auto beam = [&](const Vec3<double>& wi) {
        const double value = dot(wi, axis) > std::cos(0.01) ? 1.0 : 0.0;
        return Vec3<double>{value, value, value};
    };
    const auto nodes = make_line_nodes(line, 1.0, beam);
    for (int k = 0; k <= 32; ++k) ASSERT_EQ(nodes.radiance[0][k], 0);
    const Technique<double> technique(line, nodes);
    EXPECT_GT(technique.pdf(axis), 0);
    // Without a typical radiance, nothing tells of it.
    const auto black = make_line_nodes(line, 0.0, beam);
    EXPECT_EQ(Technique<double>(line, black).measure(), 0);
}

template <class T>
class HostileNodes : public ::testing::Test {};
using Numbers = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(HostileNodes, Numbers);

TYPED_TEST(HostileNodes, AreFinite) {
    using T = TypeParam;
    const T big = T(1e33), small = T(1e-33);
    const std::vector<LineSegment<T>> hostile = {{{T(0), T(0), T(0)}, {T(1), T(0), T(0)}, T(1)},
                                                 {{T(0), T(0), T(1)}, {T(1), T(0), T(0)}, T(0)},
                                                 {{T(0), T(0), T(1)}, {T(0), T(0), T(1)}, T(1)},
                                                 {{T(-1), T(0), T(0)}, {T(1), T(0), T(0)}, T(2)},
                                                 {{-big, big, big}, {T(1), T(0), T(0)}, big},
                                                 {{small, small, small}, {T(0), T(1), T(0)}, small},
                                                 {{T(-0.5), T(0), small}, {T(1), T(0), T(0)}, T(1)},
                                                 {{T(1), T(0), T(1)}, {T(0), T(1), T(0)}, big},
                                                 {{big, T(0), T(1)}, {T(0), T(1), T(0)}, T(1)},
                                                 {{T(0), T(-1), T(-1)}, {T(0), T(1), T(0)}, T(2)}};
    const Beam<T> beam{{T(0), T(0), T(1)}, T(8)};
    for (const LineSegment<T>& line : hostile) {
        const auto nodes = make_line_nodes(line, T(1), beam);
        for (int k = 0; k < 32; ++k) EXPECT_LT(nodes.border[k], nodes.border[k + 1]);
        const Technique<T> technique(line, nodes);
        for (const T u : {T(0), T(0.3), T(1) - std::numeric_limits<T>::epsilon()}) {
            const auto s = technique.sample(u);
            EXPECT_TRUE(std::isfinite(s.wi.x + s.wi.y + s.wi.z + s.pdf + s.at));
            EXPECT_GE(s.pdf, 0);
            EXPECT_TRUE(std::isfinite(technique.pdf(s.wi)));
        }
    }
}

} // namespace
} // namespace nusselt_test
