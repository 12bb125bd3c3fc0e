#include "experiments/accuracy.h"

#include "experiments/accuracy_lights.h"

#include <nusselt/related/line_projected_solid_angle_peters.h>
#include <nusselt/related/polygon_projected_solid_angle_peters.h>
#include <nusselt/related/polygon_solid_angle_peters.h>
#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

#include <algorithm>
#include <cmath>

namespace nusselt::experiments {

namespace {

using Exact = long double;

/// The light that the floats describe: vertex 0 and the edges, without rounding.
ConvexPolygon<Exact, 4> widened(const ConvexPolygon<float, 4>& light) {
    ConvexPolygon<Exact, 4> exact;
    exact.vertex[0] = broadcast<Exact>(light.vertex[0]);
    Vec3<Exact> sum{0, 0, 0};
    for (int j = 0; j < 3; ++j) {
        exact.edge[j] = broadcast<Exact>(light.edge[j]);
        exact.vertex[j + 1] = exact.vertex[j] + exact.edge[j];
        sum = sum + exact.edge[j];
    }
    exact.edge[3] = -sum;
    exact.normal = normalize(doubled_area_normal(exact));
    return exact;
}

LineSegment<Exact> widened(const LineSegment<float>& light) {
    return {broadcast<Exact>(light.p0), normalize(broadcast<Exact>(light.s)), light.length};
}

/// Angle by which a unit direction misses a light, 0 on it.
Exact miss(const ConvexPolygon<Exact, 4>& light, const Vec3<Exact>& wi) {
    const Exact side = dot(light.normal, light.vertex[0]) < 0 ? -1 : 1;
    Exact worst = 0;
    for (int j = 0; j < 4; ++j) {
        const Vec3<Exact> n = cross(light.vertex[j], light.edge[j]);
        const Exact norm = length(n);
        if (norm > 0) worst = std::max(worst, -side * dot(n, wi) / norm);
    }
    return worst;
}

Exact miss(const LineSegment<Exact>& light, const Vec3<Exact>& wi) {
    const Vec3<Exact> end = light.p0 + light.length * light.s;
    const Vec3<Exact> n = normalize(cross(light.p0, light.s));
    const Exact before = -dot(cross(n, normalize(light.p0)), wi);
    const Exact after = dot(cross(n, normalize(end)), wi);
    return std::max({std::fabs(dot(n, wi)), before, after});
}

template <class Random>
Exact first(const Random& u) {
    if constexpr (std::is_class_v<Random>) {
        return u.x;
    } else {
        return u;
    }
}

float random_number(Engine& engine) { return std::uniform_real_distribution<float>(0, 0.999999f)(engine); }

/// A random number per dimension that lights of a kind need.
struct PolygonRandom {
    Vec2<float> operator()(Engine& engine) const { return {random_number(engine), random_number(engine)}; }
};
struct LineRandom {
    float operator()(Engine& engine) const { return random_number(engine); }
};
Vec2<Exact> widened(const Vec2<float>& u) { return broadcast<Exact>(u); }
Exact widened(float u) { return u; }

/// Collects the errors of one row.
class Row {
public:
    Row(const char* technique, const char* lights, const char* method) {
        row_.technique = technique;
        row_.lights = lights;
        row_.method = method;
    }

    void add_measure(Exact measured, Exact exact) {
        if (!is_finite(measured)) ++row_.invalid;
        measure_.push_back(static_cast<double>(std::fabs(measured / exact - 1)));
    }

    /// \param pdf    of the sample; 0 counts as no sample.
    /// \param exact  the same technique in long double.
    template <class Light, class Technique, class Random>
    void add_direction(const Light& light, const Technique& exact, const Random& u, const Vec3<float>& wi,
                       float pdf) {
        ++count_;
        if (!(is_finite(wi.x) && is_finite(wi.y) && is_finite(wi.z) && is_finite(pdf) && pdf >= 0)) {
            ++row_.invalid;
            return;
        }
        if (pdf == 0) {
            ++empty_;
            return;
        }
        const Vec3<Exact> direction = normalize(broadcast<Exact>(wi));
        if (miss(light, direction) > 4 * std::numeric_limits<float>::epsilon()) ++off_;
        backward_.push_back(static_cast<double>(std::fabs(first(exact.invert(direction)) - first(u))));
    }

    AccuracyRow finished() {
        row_.backward = quantiles(backward_);
        row_.measure = quantiles(measure_);
        const double count = static_cast<double>(std::max<std::int64_t>(count_, 1));
        row_.off_the_light = static_cast<double>(off_) / count;
        row_.no_sample = static_cast<double>(empty_) / count;
        return row_;
    }

private:
    static ErrorQuantiles quantiles(std::vector<double>& errors) {
        if (errors.empty()) return {};
        // NaN counts as the largest error.
        for (double& e : errors)
            if (std::isnan(e)) e = std::numeric_limits<double>::infinity();
        std::sort(errors.begin(), errors.end());
        const auto at = [&](double share) {
            return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
        };
        return {at(0.5), at(0.99), at(0.999), errors.back()};
    }

    AccuracyRow row_;
    std::vector<double> backward_, measure_;
    std::int64_t count_ = 0, off_ = 0, empty_ = 0;
};

/// Lights dimmer than this are left out: their share of an image is nothing, their relative error anything.
constexpr Exact kSmallestMeasure = 1e-12L;

/// \tparam Plain  the competitor, or Ours if there is none.
template <class Plain, class Ours, class Reference, class Class, class MakeRandom>
void measure_class(const char* technique, const Class& lights, int count, MakeRandom make_random,
                   std::vector<AccuracyRow>& rows) {
    Engine engine(1);
    Row plain(technique, lights.name, "plain");
    Row ours(technique, lights.name, "ours");
    Row floor(technique, lights.name, "floor");
    for (int i = 0; i < count; ++i) {
        const auto light = lights.make(engine);
        const auto u = make_random(engine);
        const auto exact_light = widened(light);
        const Reference exact(exact_light);
        if (!(exact.measure() > kSmallestMeasure)) continue;
        const Ours technique_ours(light);
        ours.add_measure(technique_ours.measure(), exact.measure());
        const auto sample = technique_ours.sample(u);
        ours.add_direction(exact_light, exact, u, sample.wi, sample.pdf);
        if constexpr (!std::is_same_v<Plain, Ours>) {
            const Plain technique_plain(light);
            plain.add_measure(technique_plain.measure(), exact.measure());
            const auto plain_sample = technique_plain.sample(u);
            plain.add_direction(exact_light, exact, u, plain_sample.wi, plain_sample.pdf);
        }
        const auto best = exact.sample(widened(u));
        floor.add_direction(exact_light, exact, u, broadcast<float>(best.wi), static_cast<float>(best.pdf));
    }
    if constexpr (!std::is_same_v<Plain, Ours>) rows.push_back(plain.finished());
    rows.push_back(ours.finished());
    rows.push_back(floor.finished());
}

/// A technique in single precision, its competitor if there is one, and in long double.
template <class Plain, class Ours, class Reference>
void measure_polygons(const char* technique, int count, std::vector<AccuracyRow>& rows) {
    for (const PolygonClass& lights : polygon_classes())
        measure_class<Plain, Ours, Reference>(technique, lights, count, PolygonRandom{}, rows);
}
template <class Plain, class Ours, class Reference>
void measure_lines(const char* technique, int count, std::vector<AccuracyRow>& rows) {
    for (const LineClass& lights : line_classes())
        measure_class<Plain, Ours, Reference>(technique, lights, count, LineRandom{}, rows);
}

} // namespace

std::vector<AccuracyRow> measure_accuracy(int count) {
    std::vector<AccuracyRow> rows;
    // The reference takes more steps than the technique under test.
    measure_polygons<PolygonProjectedSolidAnglePeters<float, 4>, PolygonProjectedSolidAngle<float, 4>,
                     PolygonProjectedSolidAngle<Exact, 4, 4>>("PolygonProjectedSolidAngle", count, rows);
    measure_polygons<PolygonSolidAnglePeters<float, 4>, PolygonSolidAngle<float, 4>,
                     PolygonSolidAngle<Exact, 4>>("PolygonSolidAngle", count, rows);
    measure_polygons<PolygonArea<float, 4>, PolygonArea<float, 4>, PolygonArea<Exact, 4>>("PolygonArea",
                                                                                          count, rows);
    measure_lines<LineProjectedSolidAnglePeters<float>, LineProjectedSolidAngle<float>,
                  LineProjectedSolidAngle<Exact, 5>>("LineProjectedSolidAngle", count, rows);
    measure_lines<LineSolidAngle<float>, LineSolidAngle<float>, LineSolidAngle<Exact>>("LineSolidAngle",
                                                                                       count, rows);
    measure_lines<LineArea<float>, LineArea<float>, LineArea<Exact>>("LineArea", count, rows);
    return rows;
}

} // namespace nusselt::experiments
