#include "lab/statements/measurements.h"
#include "tables/ltc_table.h"

#include <nusselt/estimate/reference_integrals.h>
#include <nusselt/ltc/line_shading.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nusselt::lab {

namespace {

using Line = LineSegment<double>;
using Direction = Vec3<double>;
using Coefficients = LtcCoefficients<double>;

/// Above the surface, on it, through it, and longer than they are away.
std::vector<Line> lights() {
    return {make_line(Direction{-1, 0.5, 1}, Direction{1, 0.5, 1}),
            make_line(Direction{-0.5, -0.4, 0.7}, Direction{-1.5, 0.8, 2}),
            make_line(Direction{1, 0.3, 0}, Direction{-0.4, -0.5, 1}),
            make_line(Direction{-1, 0.3, -0.5}, Direction{-0.4, -0.5, 1}),
            make_line(Direction{-0.5, 0.2, 0.1}, Direction{-0.5, 0.2, 2}),
            make_line(Direction{-3, 0.1, 0.4}, Direction{2, 0, 0.4}),
            make_line(Direction{-1, 0.5, 2}, Direction{-1.01, 0.52, 2.01})};
}

/// Lobes of the shipped table, from rough to glossy and from the normal to grazing angles.
std::vector<Coefficients> lobes() {
    std::vector<Coefficients> all;
    for (const double roughness : {0.25, 0.5, 0.9})
        for (const double cos_o : {1.0, 0.6, 0.15})
            all.push_back(tables::frostbite_ltc_table().view().lookup(roughness, cos_o, 0.04));
    return all;
}

/// The midpoint rule, extrapolated from two steps: its error goes with the square of the step.
template <class Density>
double quadrature(const Line& light, const Density& density, int steps) {
    const double coarse = reference_line_integral(light, density, steps);
    const double fine = reference_line_integral(light, density, 2 * steps);
    return fine + (fine - coarse) / 3;
}

/// Eq. 1.21 to 1.23 of Heitz and Hill as printed, for a line above the surface. Cancels for distant lines.
double printed_irradiance(const Direction& p1, const Direction& p2) {
    const Direction tangent = normalize(p2 - p1);
    const Direction closest = p1 - dot(p1, tangent) * tangent;
    const double d = length(closest);
    const auto along_closest = [&](double l) {
        return l / (d * (d * d + l * l)) + std::atan(l / d) / (d * d);
    };
    const auto along_tangent = [&](double l) { return l * l / (d * (d * d + l * l)); };
    const double l1 = dot(p1, tangent);
    const double l2 = dot(p2, tangent);
    return ((along_closest(l2) - along_closest(l1)) * closest.z +
            (along_tangent(l2) - along_tangent(l1)) * tangent.z) /
           kPi<double>;
}

/// The same with the part below the surface cut off.
double printed_irradiance(const Line& light) {
    Direction p1 = light.p0;
    Direction p2 = end_of(light);
    if (std::max(p1.z, p2.z) <= 0) return 0;
    const auto crossing = [&] { return (1 / (p1.z - p2.z)) * (p1.z * p2 - p2.z * p1); };
    if (p1.z < 0) p1 = crossing();
    if (p2.z < 0) p2 = crossing();
    return printed_irradiance(p1, p2);
}

Line image_of(const Line& light, const Coefficients& c) {
    const auto image = [&](const Direction& v) {
        return Direction{c.m00 * v.x + c.m02 * v.z, c.m11 * v.y, c.m20 * v.x + c.m22 * v.z};
    };
    return make_line(image(light.p0), image(end_of(light)));
}

/// The width factor of Eq. 1.26: one over the length of M^T w, w the normal of the plane through the line and the origin. The
/// coefficients are those of the inverse of M, so that M^T is the matrix of their cofactors over the determinant.
double width_factor(const Line& light, const Coefficients& c) {
    const Direction w = normalize(cross(light.p0, light.s));
    const double minor = c.m00 * c.m22 - c.m02 * c.m20;
    const Direction turned{c.m11 * (c.m22 * w.x - c.m20 * w.z), minor * w.y,
                           c.m11 * (c.m00 * w.z - c.m02 * w.x)};
    return c.m11 * minor / length(turned);
}

double relative(double value, double expected) { return std::fabs(value / expected - 1); }

} // namespace

Findings measure_closed_forms(Effort effort) {
    const int steps = effort == Effort::quick ? 10'000 : 100'000;
    // The quadrature agrees with itself to a tenth of this.
    constexpr double kTolerance = 1e-8;
    double diffuse = 0, printed_diffuse = 0, lobe = 0, printed_lobe = 0, without_factor = 0;
    int diffuse_cases = 0, lobe_cases = 0;
    const auto lambertian = [](const Direction& wi) { return std::max(wi.z, 0.0) / kPi<double>; };
    for (const Line& light : lights()) {
        const double expected = quadrature(light, lambertian, steps);
        diffuse = std::max(diffuse, relative(diffuse_integral(light), expected));
        printed_diffuse = std::max(printed_diffuse, relative(printed_irradiance(light), expected));
        ++diffuse_cases;
        for (const Coefficients& coefficients : lobes()) {
            const Ltc<double> ltc(coefficients);
            const double in_lobe = quadrature(
                light, [&](const Direction& wi) { return ltc.density(wi); }, steps);
            // Less than a hundredth of a tube as thick as its distance.
            if (in_lobe < 1e-2) continue;
            ++lobe_cases;
            const double image = printed_irradiance(image_of(light, coefficients));
            lobe = std::max(lobe, relative(lobe_integral(light, ltc), in_lobe));
            printed_lobe =
                std::max(printed_lobe, relative(width_factor(light, coefficients) * image, in_lobe));
            without_factor = std::max(without_factor, relative(image, in_lobe));
        }
    }
    const std::string lines = fmt::format(", {} lines", diffuse_cases);
    const std::string pairs = fmt::format(", {} pairs of line and lobe", lobe_cases);
    const char* const kDiffuse = "ltc-lines-sec-1.3-diffuse";
    const char* const kInvariance = "ltc-lines-sec-1.4.3-invariance";
    const char* const kFactor = "lines-sec-4.1-radius-factor";
    return {{at_most(kDiffuse, "our closed form, relative deviation from quadrature" + lines, diffuse,
                     kTolerance),
             at_most(kDiffuse, "Eq. 1.21, relative deviation from quadrature" + lines, printed_diffuse,
                     kTolerance),
             at_least(kInvariance, "pairs whose integral is at least 0.01", lobe_cases, 20),
             at_most(kInvariance, "our closed form, relative deviation from quadrature" + pairs, lobe,
                     kTolerance),
             at_most(kInvariance, "Eq. 1.26, relative deviation from quadrature" + pairs, printed_lobe,
                     kTolerance),
             at_most(kFactor, "with the factor, relative deviation from quadrature" + pairs, printed_lobe,
                     kTolerance),
             at_least(kFactor, "without the factor, relative deviation from quadrature" + pairs,
                      without_factor, 0.1)}};
}

} // namespace nusselt::lab
