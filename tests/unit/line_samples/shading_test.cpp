/// Compares closed forms along parts of lines with quadrature, and integrals over all lines with the closed forms for
/// polygons.

#include <algorithm>

#include <gtest/gtest.h>

#include <nusselt/line_samples/shading.h>
#include <nusselt/ltc/polygon_shading.h>

#include "line_samples/parts.h"
#include "ltc/lobes.h"

namespace nusselt_test {
namespace {

using nusselt::BothSides;
using nusselt::diffuse_part;
using nusselt::FrontSide;
using nusselt::Interval;
using nusselt::LineFamily;
using nusselt::lobe_part;
using nusselt::LobePlane;
using nusselt::Ltc;
using nusselt::ScaledPlane;

/// Lights of all sizes, from next to the point to far away.
struct Place {
    const char* name;
    double distance, size;
};
constexpr Place kPlaces[] = {
    {"moderate", 2, 1}, {"1 mm at 40 m", 40, 1e-3}, {"around the point", 0.01, 10}, {"huge", 1e3, 1e6}};

long double exact_diffuse(const ExactPart& part) {
    return part.integral([](const Point& wi) { return std::max(wi.z, 0.0L) / kPi; });
}

TEST(DiffusePart, EqualsQuadratureInDouble) {
    for (const Place& place : kPlaces) {
        RandomSource random(1);
        int lit = 0;
        for (int k = 0; k < 600; ++k) {
            const RandomPart<double> part(random, 3 + k % 6, place.distance, place.size);
            const double exact = static_cast<double>(exact_diffuse(part.exact(part.part)));
            EXPECT_NEAR(diffuse_part(part.cosine(), part.part), exact, 1e-10 * exact) << place.name;
            lit += exact > 0;
        }
        EXPECT_GT(lit, 100);
    }
}

TEST(DiffusePart, TestRejectsAMovedLine) {
    RandomSource random(1);
    int failures = 0;
    for (int k = 0; k < 600; ++k) {
        const RandomPart<double> part(random, 3 + k % 6, 2, 1);
        const double exact = static_cast<double>(exact_diffuse(part.exact(part.part)));
        const double moved =
            diffuse_part(LobePlane<double>(part.scaled_plane()).line(part.offset + 1e-6), part.part);
        failures += !(std::fabs(moved - exact) <= 1e-10 * exact);
    }
    EXPECT_GT(failures, 100);
}

TEST(DiffusePart, EqualsQuadratureInFloat) {
    for (const Place& place : kPlaces) {
        RandomSource random(2);
        std::vector<double> errors;
        for (int k = 0; k < 600; ++k) {
            const RandomPart<float> part(random, 3 + k % 6, place.distance, place.size);
            const double exact = static_cast<double>(exact_diffuse(part.exact(part.part)));
            if (!(exact > 0)) continue;
            const double value = static_cast<double>(diffuse_part(part.cosine(), part.part));
            errors.push_back(std::fabs(value - exact) / exact);
        }
        std::sort(errors.begin(), errors.end());
        // Relative to the distance, positions on large lights have larger rounding errors.
        const double rounding = std::max(place.size / place.distance, 1.0);
        EXPECT_LT(errors[errors.size() / 2], 3e-7 * rounding) << place.name;
        EXPECT_LT(errors[errors.size() * 9 / 10], 4e-6 * rounding) << place.name;
        // The largest errors come from rounded positions of lights that are seen edge-on and of lines that nearly hit
        // the point.
        EXPECT_LT(errors.back(), 1e-2 * rounding) << place.name;
    }
}

/// Integral of a lobe over the part that is above the horizon of the lobe.
double above_its_horizon(const RandomPart<double>& part, const Ltc<double>& ltc) {
    const auto lobe = LobePlane<double>(part.scaled_plane(), ltc).line(part.offset);
    return lobe.integral(lobe.clipped(part.part));
}

/// Integral of a lobe over the part that is above both the horizon of the lobe and the surface.
double above_both_horizons(const RandomPart<double>& part, const Ltc<double>& ltc) {
    return lobe_part(part.cosine(), LobePlane<double>(part.scaled_plane(), ltc).line(part.offset), part.part);
}

using Integral = double (*)(const RandomPart<double>&, const Ltc<double>&);

void expect_lobe_equals_quadrature(const std::vector<NamedLobe>& lobes, Integral integral) {
    for (const NamedLobe& lobe : lobes) {
        const Ltc<long double> exact_ltc(lobe.coefficients);
        const auto& c = lobe.coefficients;
        const Ltc<double> ltc(nusselt::LtcCoefficients<double>{
            static_cast<double>(c.m00), static_cast<double>(c.m02), static_cast<double>(c.m11),
            static_cast<double>(c.m20), static_cast<double>(c.m22), 1});
        const Point axis = normalize(exact_ltc.to_shading({0, 0, 1}));
        const long double width = 1 / std::sqrt(exact_ltc.density(axis));
        RandomSource random(3);
        int lit = 0;
        for (int k = 0; k < 300; ++k) {
            const RandomPart<double> part(random, 3 + k % 6, random.log_between(0.1, 10), 2);
            ExactPart exact_part = part.exact(part.part);
            exact_part.split_at({c.m20, 0, c.m22});
            exact_part.split_at_peak(axis, width);
            const double exact = static_cast<double>(exact_part.integral([&](const Point& wi) {
                if (integral == above_both_horizons && wi.z <= 0) return 0.0L;
                return exact_ltc.density(wi);
            }));
            // The coefficients are rounded, which turns narrow lobes by more relative to their width.
            const double rounding = 1e-10 + 1e-15 / static_cast<double>(width * width);
            EXPECT_NEAR(integral(part, ltc), exact, rounding * exact) << lobe.name;
            lit += exact > 0;
        }
        EXPECT_GT(lit, 30);
    }
}

TEST(LobePart, EqualsQuadrature) { expect_lobe_equals_quadrature(wide_lobes(), above_its_horizon); }
TEST(LobePart, EqualsQuadratureAboveTheSurface) {
    expect_lobe_equals_quadrature(wide_lobes(), above_both_horizons);
}
TEST(LobePart, EqualsQuadratureForNarrowLobes) {
    std::vector<NamedLobe> lobes = all_lobes();
    lobes.erase(lobes.begin(), lobes.begin() + 4);
    expect_lobe_equals_quadrature(lobes, above_both_horizons);
}

TEST(Sides, BothAreTheFrontAndTheBack) {
    RandomSource random(4);
    for (int k = 0; k < 300; ++k) {
        const RandomPart<double> part(random, 3 + k % 6, 2, 1);
        nusselt::LinePlane<double> turned = part.family.plane();
        turned.normal = -turned.normal;
        const ScaledPlane<double> turned_plane(turned, part.family.reach());
        const double front = diffuse_part(part.cosine(), part.part);
        const double back = diffuse_part(LobePlane<double>(turned_plane).line(part.offset), part.part);
        EXPECT_TRUE(front == 0 || back == 0);
        const LobePlane<double, BothSides> both(turned_plane);
        EXPECT_EQ(diffuse_part(both.line(part.offset), part.part), front + back);
    }
}

TEST(Sides, PointsOnThePlaneSeeNothing) {
    RandomSource random(6);
    for (int k = 0; k < 1000; ++k) {
        RandomPart<float> part(random, 4, 2, 1);
        for (auto& vertex : part.light.vertex) vertex.x = 0;
        const auto light = nusselt::make_polygon<8>(part.light.vertex, 4);
        const LineFamily<float, 8> family(light, static_cast<float>(random.between(0, 3)));
        const float offset = family.sample_uniform(0.4f).offset;
        const LobePlane<float, BothSides> lines({family.plane(), family.reach()});
        EXPECT_EQ(diffuse_part(lines.line(offset), family.chord(offset).extent), 0);
    }
}

/// Integral over all lines of a light, one piece at a time between the knots, where the length of the chord has a
/// kink.
template <class Function>
double over_lines(const LineFamily<double, 8>& family, const nusselt::ConvexPolygon<double, 8>& light,
                  const Function& f) {
    static const QuadratureRule rule = gauss_legendre(64);
    std::vector<double> knots;
    for (const auto& vertex : light.vertex)
        knots.push_back(dot(vertex - family.plane().origin, family.plane().across));
    std::sort(knots.begin(), knots.end());
    double sum = 0;
    for (std::size_t k = 0; k + 1 < knots.size(); ++k)
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double width = knots[k + 1] - knots[k];
            const double offset = knots[k] + width * static_cast<double>(rule.nodes[i]);
            sum += static_cast<double>(rule.weights[i]) * width * f(offset, family.chord(offset).extent);
        }
    return sum;
}

/// A light above the horizon that shines towards the point.
nusselt::ConvexPolygon<double, 8> light_above(RandomSource& random, int vertices) {
    for (;;) {
        auto light = ellipse_polygon<double, 8>(random, vertices, 3, 1);
        double lowest = light.vertex[0].z;
        for (const auto& vertex : light.vertex) lowest = std::min(lowest, vertex.z);
        const double front = -dot(light.normal, light.vertex[0]);
        if (lowest > 0.1 && front > 0.3) return light;
    }
}

TEST(Lines, IntegrateToThePolygon) {
    RandomSource random(7);
    const Ltc<double> ltc(nusselt::LtcCoefficients<double>{1, 0.3, 0.9, 0, 0.4, 1});
    for (int k = 0; k < 60; ++k) {
        const auto light = light_above(random, 3 + k % 6);
        const LineFamily<double, 8> family(light, random.between(0, 3.14159));
        const ScaledPlane<double> plane(family.plane(), family.reach());
        const double diffuse = over_lines(family, light, [&](double offset, const Interval<double>& chord) {
            return diffuse_part(LobePlane<double>(plane).line(offset), chord);
        });
        EXPECT_NEAR(diffuse, diffuse_integral(light), 1e-12);
        const double lobe = over_lines(family, light, [&](double offset, const Interval<double>& chord) {
            const auto line = LobePlane<double>(plane, ltc).line(offset);
            return line.integral(line.clipped(chord));
        });
        EXPECT_NEAR(lobe, nusselt::lobe_integral<nusselt::CosineHorizon>(light, ltc), 1e-12);
    }
}

// The integrand has kinks where lines start to cross the horizon, so the quadrature is less accurate.
TEST(Lines, IntegrateToThePartOfThePolygonAboveTheHorizon) {
    RandomSource random(9);
    for (int k = 0; k < 60; ++k) {
        const auto light = ellipse_polygon<double, 8>(random, 3 + k % 6, 2, 1.5);
        const LineFamily<double, 8> family(light, random.between(0, 3.14159));
        const ScaledPlane<double> plane(family.plane(), family.reach());
        const double diffuse = over_lines(family, light, [&](double offset, const Interval<double>& chord) {
            return diffuse_part(LobePlane<double, BothSides>(plane).line(offset), chord);
        });
        EXPECT_NEAR(diffuse, diffuse_integral(light), 1e-5);
    }
}

} // namespace
} // namespace nusselt_test
