#include "lab/statements/measurements.h"
#include "tables/ltc_table.h"

#include <nusselt/estimate/reference_integrals.h>
#include <nusselt/ltc/line_shading.h>
#include <nusselt/sampling/cylinder_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nusselt::lab {

namespace {

using Direction = Vec3<double>;
using Line = LineSegment<double>;

/// Halved from one to the next; lights are about 1 m away.
constexpr double kThicknesses[] = {0.32, 0.16, 0.08, 0.04, 0.02, 0.01};
constexpr std::size_t kCount = std::size(kThicknesses);

/// How much a light of finite thickness differs from its limit, over its thickness.
struct Limit {
    const char* item;
    std::string name;
    double expected_order;      ///< the power of the thickness with which the difference goes
    double differences[kCount]; ///< relative, for each thickness

    /// That power, from the two thinnest.
    double order() const { return std::log2(differences[kCount - 2] / differences[kCount - 1]); }
};

template <class Difference>
Limit limit_of(const char* item, std::string name, double expected_order, const Difference& difference) {
    Limit limit{item, std::move(name), expected_order, {}};
    for (std::size_t i = 0; i < kCount; ++i) limit.differences[i] = std::fabs(difference(kThicknesses[i]));
    return limit;
}

Line slanted_line() { return make_line(Direction{-0.5, 0.2, 1}, Direction{0.75, 0.4, 1.25}); }

std::vector<Limit> measure(Effort effort) {
    const int around = effort == Effort::quick ? 300 : 600;
    const int along = 2 * around;
    const Line tube = slanted_line();
    // One end shows its cap to the origin, the other one its back.
    const Line upright = make_line(Direction{-0.3, 0.2, 1}, Direction{-0.75, 0.4, 3});
    const Ltc<double> ltc(tables::frostbite_ltc_table().view().lookup(0.7, 0.8, 0.04));
    const auto density = [&](const Direction& wi) { return ltc.density(wi); };
    const double line = lobe_integral(tube, ltc);
    const double solid_angle = LineSolidAngle<double>(tube).measure();

    std::vector<Limit> limits;
    limits.push_back(
        limit_of("lines-sec-3.1-solid-angle", "solid angle of a cylinder", 1, [&](double radius) {
            return CylinderSolidAngle<double>(Cylinder<double>{tube, radius}).measure() / radius /
                       solid_angle -
                   1;
        }));
    limits.push_back(limit_of("ltc-lines-sec-1.2.5-limit", "lobe over a cylinder", 1, [&](double radius) {
        return reference_tube_integral(tube, radius, density, around, along) / radius / line - 1;
    }));
    limits.push_back(limit_of("ltc-lines-sec-1.5.3-caps-limit", "lobe over caps", 2, [&](double radius) {
        return reference_caps_integral(upright, radius, density, 100, 200) /
                   caps_integral(upright, radius, density) -
               1;
    }));
    const Direction across = normalize(cross(tube.p0, tube.s));
    const Direction towards = cross(tube.s, across);
    for (const double degrees : {0.0, 35.0, 70.0}) {
        const double angle = degrees * (kPi<double> / 180);
        const Direction normal = std::cos(angle) * towards + std::sin(angle) * across;
        limits.push_back(limit_of(
            "ltc-lines-sec-1.6-rectangle",
            fmt::format("lobe over a rectangle, turned by {:g} degrees", degrees), 2, [&](double width) {
                return reference_strip_integral(tube, normal, width, density, around / 2, along) /
                           strip_integral(tube, normal, width, line) -
                       1;
            }));
    }
    return limits;
}

/// The closed form of Sec. 3.1, for any radius.
double printed_solid_angle(const Line& light) {
    const Direction p1 = end_of(light);
    const double distance = length(light.p0 - dot(light.p0, light.s) * light.s);
    return 2 / distance * (dot(p1, light.s) / length(p1) - dot(light.p0, light.s) / length(light.p0));
}

} // namespace

Findings measure_thin_lights(Effort effort) {
    const std::vector<Limit> limits = measure(effort);
    Findings findings;
    const Line line = slanted_line();
    findings.all.push_back(
        at_most(limits[0].item, "closed form of the limit, relative deviation of LineSolidAngle",
                std::fabs(LineSolidAngle<double>(line).measure() / printed_solid_angle(line) - 1), 1e-12));
    Table table = {{"relative difference from the limit"}};
    for (const double thickness : kThicknesses) table[0].push_back(fmt::format("{:g} m", thickness));
    Plot plot{"lights of finite thickness", "thin-lights", "radius or width [m]", "relative difference", {}};
    for (const Limit& limit : limits) {
        table.push_back({limit.name});
        PlotCurve curve{limit.name, {}};
        for (std::size_t i = 0; i < kCount; ++i) {
            const double difference = limit.differences[i];
            table.back().push_back(fmt::format("{:.2e}", difference));
            curve.points.push_back({kThicknesses[i], difference, difference, difference});
        }
        plot.curves.push_back(std::move(curve));
        findings.all.push_back(
            at_most(limit.item,
                    fmt::format("{}, relative difference at {:g} m", limit.name, kThicknesses[kCount - 1]),
                    limit.differences[kCount - 1], 0.02));
        findings.all.push_back(
            between(limit.item, limit.name + ", power of the thickness with which it falls", limit.order(),
                    limit.expected_order - 0.1, limit.expected_order + 0.1));
    }
    findings.tables.push_back(std::move(table));
    findings.plots.push_back(std::move(plot));
    return findings;
}

} // namespace nusselt::lab
