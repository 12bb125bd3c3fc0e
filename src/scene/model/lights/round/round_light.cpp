#include "scene/model/lights/round/round_light.h"

#include "scene/model/bounds.h"
#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/lights/light_text.h"
#include "scene/model/lights/round/round_axes.h"
#include "scene/model/number_text.h"
#include "scene/model/transform.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace nusselt::scene {

namespace {

using Kind = LightKind<RoundLight>;

/// Carlson's symmetric integrals R_F and R_D by duplication: B. C. Carlson 1995, Numerical computation of real or complex
/// elliptic integrals, doi:10.1007/BF02198293, equations 2.1 and 2.5 to 2.7 in the limit of equal arguments.
/// \param x, y, z at most one of x and y is 0, z is positive
struct CarlsonIntegrals {
    CarlsonIntegrals(double x, double y, double z) {
        double sum = 0;
        double power = 1;
        // Each step divides the differences by 4; the remaining error is their square.
        for (int step = 0; step < 30; ++step) {
            const double lambda = std::sqrt(x * y) + std::sqrt(y * z) + std::sqrt(z * x);
            sum += power / (std::sqrt(z) * (z + lambda));
            power /= 4;
            x = (x + lambda) / 4;
            y = (y + lambda) / 4;
            z = (z + lambda) / 4;
        }
        rf = 1 / std::sqrt(z);
        rd = 3 * sum + power / (z * std::sqrt(z));
    }
    double rf, rd;
};

/// The area of an ellipsoid: 4 pi R_G(a^2 b^2, a^2 c^2, b^2 c^2). \param s semi-axes, the longest first, positive
double ellipsoid_area(const std::array<double, 3>& s) {
    // In units of the longest one, which is 1. The middle argument comes last, so that no term is negative.
    const double b = s[1] / s[0];
    const double c = s[2] / s[0];
    const double x = b * b;
    const double y = b * b * c * c;
    const double z = c * c;
    const CarlsonIntegrals integrals(x, y, z);
    const double rg = 0.5 * (z * integrals.rf - (x - z) * (y - z) * integrals.rd / 3 + std::sqrt(x * y / z));
    return 4 * std::numbers::pi * s[0] * s[0] * rg;
}

/// Whether lengths are alike for readers of reports.
bool are_alike(double a, double b) { return std::fabs(a - b) <= 1e-4 * a; }

} // namespace

std::array<double, 3> semi_axes(const RoundLight& light) {
    // The eigenvalues of the Gram matrix are their squares. Rotations of pairs of columns make it diagonal.
    std::array<Double3, 3> column = RoundAxes(light).axis;
    for (int sweep = 0; sweep < 12; ++sweep) {
        for (const auto& [i, k] : {std::pair{0u, 1u}, {0u, 2u}, {1u, 2u}}) {
            const double both = dot(column[i], column[k]);
            const double difference = dot(column[i] - column[k], column[i] + column[k]);
            const double angle = 0.5 * std::atan2(2 * both, difference);
            const Double3 turned = std::cos(angle) * column[i] + std::sin(angle) * column[k];
            column[k] = std::cos(angle) * column[k] - std::sin(angle) * column[i];
            column[i] = turned;
        }
    }
    std::array<double, 3> lengths = {length(column[0]), length(column[1]), length(column[2])};
    std::sort(lengths.rbegin(), lengths.rend());
    return lengths;
}

double area(const RoundLight& light) {
    if (is_flat(light)) return std::numbers::pi * length(RoundAxes(light).cofactor[2]);
    return ellipsoid_area(semi_axes(light));
}

namespace {

/// The vertices of a grid around the axis w, and its triangles with the front outwards if the axes are right-handed.
class RoundGrid {
public:
    RoundGrid(int columns, int rows) : columns_(columns), rows_(rows) {}

    /// \param make adds the vertex at (cosine, sine) of the angle around the axis, and at texture coordinates
    template <class Make>
    void add_vertices(const Make& make) const {
        for (int row = 0; row <= rows_; ++row) {
            for (int column = 0; column <= columns_; ++column) {
                // Both ends of the circle coincide exactly.
                const double angle = 2 * std::numbers::pi * (column % columns_) / columns_;
                make(std::cos(angle), std::sin(angle),
                     Float2{static_cast<float>(column) / static_cast<float>(columns_),
                            static_cast<float>(row) / static_cast<float>(rows_)});
            }
        }
    }
    /// \param has_low_pole whether the first row is a point; the last one is
    void add_triangles(bool has_low_pole, bool is_turned, std::vector<Triangle>& triangles) const {
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            triangles.push_back(is_turned ? Triangle{{a, c, b}} : Triangle{{a, b, c}});
        };
        const auto stride = static_cast<std::uint32_t>(columns_) + 1;
        for (int row = 0; row < rows_; ++row) {
            for (int column = 0; column < columns_; ++column) {
                const std::uint32_t corner =
                    static_cast<std::uint32_t>(row) * stride + static_cast<std::uint32_t>(column);
                if (row > 0 || !has_low_pole) add(corner, corner + 1, corner + stride + 1);
                if (row + 1 < rows_) add(corner, corner + stride + 1, corner + stride);
            }
        }
    }

private:
    int columns_, rows_;
};

LightSurface ellipse_surface(const RoundLight& light, const RoundAxes& axes, int sides) {
    LightSurface result;
    const Double3 center = to_double(light.center);
    const Float3 normal = to_float(normalized(axes.cofactor[2]));
    const RoundGrid grid(sides, 1);
    grid.add_vertices([&](double cosine, double sine, const Float2& uv) {
        const double radius = 1 - uv.y;
        result.positions.push_back(to_float(center + axes.point({radius * cosine, radius * sine, 0})));
        result.normals.push_back(normal);
        result.uvs.push_back(uv);
    });
    grid.add_triangles(false, false, result.triangles);
    return result;
}

LightSurface ellipsoid_surface(const RoundLight& light, const RoundAxes& axes, int sides) {
    LightSurface result;
    const Double3 center = to_double(light.center);
    const bool is_inward = light.model == RoundModel::hollow && !light.two_sided;
    const int rows = sides / 2;
    const RoundGrid grid(sides, rows);
    int vertex = 0;
    grid.add_vertices([&](double cosine, double sine, const Float2& uv) {
        const int row = vertex++ / (sides + 1);
        const double angle = std::numbers::pi * row / rows;
        const double radius = row == rows ? 0 : std::sin(angle);
        const Double3 p = {radius * cosine, radius * sine, -std::cos(angle)};
        result.positions.push_back(to_float(center + axes.point(p)));
        result.normals.push_back(to_float((is_inward ? -1.0 : 1.0) * normalized(axes.normal(p))));
        result.uvs.push_back(uv);
    });
    grid.add_triangles(true, is_inward != (axes.volume < 0), result.triangles);
    return result;
}

} // namespace

LightSurface surface(const RoundLight& light, int sides) {
    const RoundAxes axes(light);
    return is_flat(light) ? ellipse_surface(light, axes, kSidesOfEllipse * sides)
                          : ellipsoid_surface(light, axes, sides);
}

void Kind::add_to(const RoundLight& light, Bounds& bounds) {
    const RoundAxes axes(light);
    const auto extent = [&](double Double3::*coordinate) {
        return std::hypot(axes.axis[0].*coordinate, axes.axis[1].*coordinate, axes.axis[2].*coordinate);
    };
    const Double3 margin = {extent(&Double3::x), extent(&Double3::y), extent(&Double3::z)};
    bounds.add(to_double(light.center) - margin);
    bounds.add(to_double(light.center) + margin);
}

// A new member does not compile until it is listed here.
void Kind::hash(const RoundLight& light, ContentHash& hash) {
    const auto& [emitter, model, center, u, v, w, radiance, two_sided] = light;
    hash.add(emitter, model, center, u, v, w, radiance, two_sided);
}

Double3 Kind::flux_per_emission(const RoundLight& light, double /*scene_radius*/) {
    return lambertian_flux((light.two_sided ? 2 : 1) * area(light));
}

void Kind::add_moment(const RoundLight& light, Moment& moment) {
    moment.add(area(light), to_double(light.center));
}

bool Kind::is_valid(const RoundLight& light) {
    constexpr double kFlattest = 1e-4;
    for (const Float3& p : {light.center, light.u, light.v, light.w})
        if (!is_valid_coordinate(p)) return false;
    Bounds bounds;
    add_to(light, bounds);
    if (!is_valid_coordinate(to_float(bounds.low)) || !is_valid_coordinate(to_float(bounds.high)))
        return false;
    const std::array<double, 3> s = semi_axes(light);
    const double shortest = is_flat(light) ? s[1] : s[2];
    // Renderers normalise normals in float.
    const double smallest_normal = s[1] * shortest;
    return shortest >= kFlattest * s[0] &&
           smallest_normal * smallest_normal >= static_cast<double>(std::numeric_limits<float>::min());
}

void Kind::transform(RoundLight& light, const Transform& transform) {
    light.center = to_float(transform_point(transform, to_double(light.center)));
    for (Float3* axis : {&light.u, &light.v, &light.w})
        *axis = to_float(transform_vector(transform, to_double(*axis)));
    // Mirror images shine to the mirrored side.
    if (is_flat(light) && linear_determinant(transform) < 0) light.v = {-light.v.x, -light.v.y, -light.v.z};
}

bool Kind::same_shape(const RoundLight& a, const RoundLight& b) {
    return a.model == b.model && a.center == b.center && a.u == b.u && a.v == b.v && a.w == b.w;
}

const bool* Kind::two_sided(const RoundLight& light) { return &light.two_sided; }

void Kind::add_mesh(const RoundLight& /*light*/, LightMesh& /*mesh*/) {}

void Kind::add_surface(const RoundLight& light, LightSurface& result) {
    result = surface(light, kRoundSides);
}

double Kind::hit(const RoundLight& light, const SightRay& ray) {
    constexpr double kMiss = std::numeric_limits<double>::infinity();
    const RoundAxes axes(light);
    const Double3 between = ray.origin - to_double(light.center);
    if (is_flat(light)) {
        const Double3& normal = axes.cofactor[2];
        const double t = -dot(between, normal) / dot(ray.direction, normal);
        if (!(t > 0)) return kMiss;
        const Double3 p = between + t * ray.direction;
        const double square = dot(normal, normal);
        const double x = dot(cross(axes.axis[1], normal), p) / square;
        const double y = dot(cross(normal, axes.axis[0]), p) / square;
        return x * x + y * y <= 1 ? t : kMiss;
    }
    const Double3 origin = axes.unit(between);
    const Double3 direction = axes.unit(ray.direction);
    const double a = dot(direction, direction);
    const double half = dot(origin, direction);
    const double root = half * half - a * (dot(origin, origin) - 1);
    if (!(root >= 0)) return kMiss;
    const double near = (-half - std::sqrt(root)) / a;
    const double far = (-half + std::sqrt(root)) / a;
    return near > 0 ? near : far > 0 ? far : kMiss;
}

std::string Kind::describe(std::span<const RoundLight> lights, double /*scene_radius*/) {
    double sum = 0;
    for (const RoundLight& light : lights) sum += area(light);
    const RoundLight& first = lights.front();
    const std::array<double, 3> s = semi_axes(first);
    const bool is_circular = are_alike(s[0], s[1]) && (is_flat(first) || are_alike(s[1], s[2]));
    const std::string name = is_flat(first) ? (is_circular ? "disk" : "ellipse")
                             : is_circular  ? "sphere"
                                            : "ellipsoid";
    const std::string size = is_circular ? "radius " + report_text(s[0])
                                         : "semi-axes " + report_text(s[0]) + " x " + report_text(s[1]) +
                                               (is_flat(first) ? "" : " x " + report_text(s[2]));
    const double sides = first.two_sided ? 2 : 1;
    return (lights.size() > 1 ? std::to_string(lights.size()) + " shapes, " : "") + name + ", " + size +
           " m, " + report_text(sum) + " m^2, radiance " + report_text(first.radiance) + " W/(sr m^2), " +
           (first.two_sided                     ? "two-sided, "
            : first.model == RoundModel::hollow ? "inwards, "
                                                : "") +
           power_text(lambertian_flux(sides * sum), first.radiance);
}

std::string Kind::rig_field(const RoundLight& light) {
    const std::string center = "{\"center\": " + triple_text(light.center);
    if (is_flat(light))
        return "\"ellipse\": " + center + ", \"axes\": [" + triple_text(light.u) + ", " +
               triple_text(light.v) + "]}";
    const std::string end = light.model == RoundModel::hollow ? ", \"inwards\": true}" : "}";
    const float r = light.u.x;
    if (r > 0 && light.u == Float3{r, 0, 0} && light.v == Float3{0, r, 0} && light.w == Float3{0, 0, r})
        return "\"sphere\": " + center + ", \"radius\": " + number_text(r) + end;
    return "\"ellipsoid\": " + center + ", \"axes\": [" + triple_text(light.u) + ", " + triple_text(light.v) +
           ", " + triple_text(light.w) + "]" + end;
}

} // namespace nusselt::scene
