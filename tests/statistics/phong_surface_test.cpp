/// Phong surfaces with the shipped table of lobes: the light that lines and points find against quadrature of the textbook
/// formula.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/estimate/direct_light.h>
#include <nusselt/estimate/line_light.h>
#include <nusselt/estimate/strategies.h>
#include <nusselt/random/light_random.h>

#include "shipped_table.h"

namespace nusselt_test {
namespace {

using nusselt::BrdfComponents;
using nusselt::ConvexPolygon;
using nusselt::Interval;
using nusselt::LambertPhong;
using nusselt::LineFamily;
using nusselt::LineLight;
using nusselt::Vec2;
using nusselt::Vec3;
using nusselt::VisibleParts;
using Direction = Vec3<double>;
using Surface = nusselt::GlossySurface<double, LambertPhong<double>>;
using Light = ConvexPolygon<double, 4>;

constexpr double kDiffuse = 0.3;
constexpr double kSpecular = 0.6;

Surface surface(double inclination, double exponent) {
    static const ShippedTable table("ltc-phong.bin");
    return nusselt::make_phong_surface<double>(std::cos(inclination), {kDiffuse, kDiffuse, kDiffuse},
                                               {kSpecular, kSpecular, kSpecular}, exponent, table.view());
}

/// Around the mirrored direction of an eye at 0.7 rad, and partly below the surface for eyes further down.
Light light() {
    const Direction vertices[] = {{-1.2, -0.5, 0.6}, {-1.3, 0.6, 0.7}, {-0.5, 0.7, 1.3}, {-0.4, -0.4, 1.2}};
    const Direction corner = vertices[0];
    const Direction across = vertices[1] - corner;
    const Direction up = vertices[3] - corner;
    const Direction corners[] = {corner, corner + across, corner + across + up, corner + up};
    return nusselt::make_polygon<4>(corners, 4);
}

/// One channel of the reflected light for a radiance of 1, by the formula of Billen and Dutre (2016, Eq. 9).
double quadrature(double inclination, double exponent) {
    const Light polygon = light();
    const Direction across = polygon.vertex[1] - polygon.vertex[0];
    const Direction up = polygon.vertex[3] - polygon.vertex[0];
    const Direction area = cross(across, up);
    const Direction mirror{-std::sin(inclination), 0, std::cos(inclination)};
    const double pi = std::acos(-1.0);
    constexpr int kNodes = 400;
    double sum = 0;
    for (int i = 0; i < kNodes; ++i)
        for (int j = 0; j < kNodes; ++j) {
            const Direction p = polygon.vertex[0] + ((i + 0.5) / kNodes) * across + ((j + 0.5) / kNodes) * up;
            const double squared = dot(p, p);
            const Direction wi = (1 / std::sqrt(squared)) * p;
            if (wi.z <= 0) continue;
            const double power = std::pow(std::max(dot(wi, mirror), 0.0), exponent);
            const double brdf = kDiffuse / pi + kSpecular * (exponent + 2) / (2 * pi) * power;
            sum += brdf * wi.z * std::fabs(dot(area, wi)) / squared;
        }
    return sum / (kNodes * kNodes);
}

/// The mean of many lines.
double by_lines(const Surface& surface, bool is_unbiased) {
    constexpr int kLines = 4000;
    const LineFamily<double, 4> family(light(), 0.7);
    const LineLight<double, LambertPhong<double>> lines(family.plane(), family.reach(), surface);
    Interval<double> storage[4];
    VisibleParts<double> parts(storage, 4);
    double sum = 0;
    for (int k = 0; k < kLines; ++k) {
        const auto choice = family.sample_by_length((k + 0.5) / kLines);
        parts.reset(family.chord(choice.offset).extent);
        const BrdfComponents<double> found =
            is_unbiased ? lines.unbiased(choice.offset, parts, 0.5) : lines.analytic(choice.offset, parts);
        sum += (found.diffuse.x + found.specular.x) / choice.pdf;
    }
    return sum / kLines;
}

/// The mean of many points, by projected solid angle and by the fitted lobe.
double by_points(const Surface& surface) {
    constexpr std::uint32_t kPoints = 1 << 15;
    const nusselt::DirectLight<double, Light, LambertPhong<double>, nusselt::ProjectedSolidAngleAndLtc>
        estimator(light(), surface);
    const nusselt::BalanceHeuristic heuristic;
    double sum = 0;
    for (std::uint32_t k = 0; k < kPoints; ++k) {
        const auto random = [&](std::uint32_t pair) {
            return nusselt::light_random<double>(nusselt::Sampler::sobol, 3, 1, 5, k, kPoints, pair);
        };
        const auto diffuse = estimator.sample_diffuse(heuristic, random(0));
        const auto specular = estimator.sample_specular(heuristic, random(1));
        sum += diffuse.shadowed.x + diffuse.constant.x + specular.shadowed.x + specular.constant.x;
    }
    return sum / kPoints;
}

constexpr double kExponents[] = {0, 1, 3.5, 30, 400, 5000};
constexpr double kInclinations[] = {0.1, 0.7, 1.3};

TEST(PhongSurface, LinesFindWhatQuadratureFinds) {
    for (const double inclination : kInclinations)
        for (const double exponent : kExponents) {
            const double expected = quadrature(inclination, exponent);
            // Quadrature by midpoints is as good as this for the narrowest lobe.
            const double tolerance = 1e-3 * expected;
            for (const bool is_unbiased : {false, true})
                EXPECT_NEAR(by_lines(surface(inclination, exponent), is_unbiased), expected, tolerance)
                    << inclination << ", " << exponent;
        }
}

TEST(PhongSurface, PointsFindWhatQuadratureFinds) {
    for (const double inclination : kInclinations)
        for (const double exponent : kExponents) {
            const double expected = quadrature(inclination, exponent);
            EXPECT_NEAR(by_points(surface(inclination, exponent)), expected, 3e-3 * expected)
                << inclination << ", " << exponent;
        }
}

/// The test of the tests. Narrower lobes are all on the light, whatever their exponent.
TEST(PhongSurface, OtherExponentsAreNoticed) {
    for (const double exponent : {3.5, 30.0}) {
        const double expected = quadrature(0.7, exponent);
        EXPECT_GT(std::fabs(by_lines(surface(0.7, 1.2 * exponent), false) / expected - 1), 4e-3) << exponent;
        EXPECT_GT(std::fabs(by_points(surface(0.7, 1.2 * exponent)) / expected - 1), 4e-3) << exponent;
    }
}

/// The albedo of the table is that of the lobe, which quadrature over the hemisphere finds.
TEST(PhongSurface, TableHasTheAlbedoOfTheLobe) {
    for (const double inclination : {0.05, 0.6, 1.2})
        for (const double exponent : {1.0, 30.0, 1000.0}) {
            const Direction mirror{-std::sin(inclination), 0, std::cos(inclination)};
            const Direction tangent{mirror.z, 0, -mirror.x};
            constexpr int kNodes = 400;
            const double pi = std::acos(-1.0);
            double sum = 0;
            for (int i = 0; i < kNodes; ++i)
                for (int j = 0; j < kNodes; ++j) {
                    const double cosine = std::pow((i + 0.5) / kNodes, 1 / (exponent + 1));
                    const double sine = std::sqrt(1 - cosine * cosine);
                    const double phi = 2 * pi * (j + 0.5) / kNodes;
                    const Direction wi =
                        sine * (std::cos(phi) * tangent + std::sin(phi) * Direction{0, 1, 0}) +
                        cosine * mirror;
                    sum += std::max(wi.z, 0.0) * (exponent + 2) / (exponent + 1);
                }
            const double albedo = sum / (kNodes * kNodes);
            EXPECT_NEAR(surface(inclination, exponent).specular_albedo.x / kSpecular, albedo, 6e-3)
                << inclination << ", " << exponent;
        }
}

} // namespace
} // namespace nusselt_test
