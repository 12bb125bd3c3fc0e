#include "scene/import/pbrt/shape_readers.h"
#include "scene/model/light_area.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace nusselt::scene {

namespace {

// Pieces around the full circle. Lights cost time per piece; those of a disk are merged to few polygons.
constexpr int kLightSides = 16;
constexpr int kDiskLightSides = 32;

/// A point of a surface at parameters (u, v) in [0, 1]^2, whose normal is that of (d/du) x (d/dv).
struct SurfacePoint {
    Double3 position;
    Double3 normal;
};

double positive_radius(ShapeDirective& shape) {
    const double radius = shape.parameters.real("radius", 1);
    if (!(radius > 0))
        throw SceneError(shape.parameters.location_of("radius"),
                         "shape \"" + shape.type + "\": radius must be positive, found " + to_text(radius));
    return radius;
}

/// The parameter "phimax", in radians.
double sweep_angle(ShapeDirective& shape) {
    return std::clamp(shape.parameters.real("phimax", 360), 0.0, 360.0) * (std::numbers::pi / 180);
}

int pieces(double angle, int per_circle) {
    return std::max(1, static_cast<int>(std::ceil(angle / (2 * std::numbers::pi) * per_circle - 1e-9)));
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto are_equal = [&](std::uint32_t i, std::uint32_t j) {
        const Float3& p = mesh.positions[i];
        const Float3& q = mesh.positions[j];
        return p.x == q.x && p.y == q.y && p.z == q.z;
    };
    // At poles quads are triangles.
    if (!are_equal(a, b) && !are_equal(b, c) && !are_equal(c, a)) mesh.triangles.push_back({{a, b, c}});
}

/// \param evaluate  SurfacePoint as a function of u and v
template <class Surface>
Mesh tessellate(ShapeDirective& shape, int columns, int rows, const Surface& evaluate) {
    Mesh mesh;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const double u = static_cast<double>(column) / columns;
            const double v = static_cast<double>(row) / rows;
            const SurfacePoint point = evaluate(u, v);
            mesh.positions.push_back(to_float(point.position));
            mesh.normals.push_back(to_float(point.normal));
            mesh.uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
        }
    }
    const auto stride = static_cast<std::uint32_t>(columns) + 1;
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
        for (std::uint32_t column = 0; column + 1 < stride; ++column) {
            const std::uint32_t corner = row * stride + column;
            add_triangle(mesh, corner, corner + 1, corner + stride + 1);
            add_triangle(mesh, corner, corner + stride + 1, corner + stride);
        }
    }
    const bool emits = !is_black(shape.emission.radiance);
    mesh.warnings.add(shape.parameters.location(), shape.type + (emits ? " that emits" : ""),
                      "shape \"" + shape.type + "\": approximated by " + std::to_string(columns) + " x " +
                          std::to_string(rows) + " flat pieces of the same area");
    return mesh;
}

/// The ratio of the exact area to that of a tessellation. Throws SceneError if one of them is zero.
double area_ratio(const ShapeDirective& shape, const Mesh& mesh, double exact_area) {
    const double flat_area = area(mesh);
    if (!(exact_area > 0) || !(flat_area > 0))
        throw SceneError(shape.parameters.location(), "shape \"" + shape.type + "\": its area is zero");
    return exact_area / flat_area;
}

/// (cosine, sine), exactly periodic, so that the ends of a full circle coincide.
std::pair<double, double> direction(double u, double sweep) {
    const double angle = u == 1 && sweep == 2 * std::numbers::pi ? 0 : u * sweep;
    return {std::cos(angle), std::sin(angle)};
}

int sides(const ShapeDirective& shape, int light_sides = kLightSides) {
    const bool emits = !is_black(shape.emission.radiance);
    return emits ? std::min(light_sides, shape.max_sides) : shape.max_sides;
}

} // namespace

Mesh read_sphere(ShapeDirective& shape) {
    ParameterList& parameters = shape.parameters;
    const double radius = positive_radius(shape);
    const double sweep = sweep_angle(shape);
    const double z_min = std::clamp(parameters.real("zmin", -radius), -radius, radius);
    const double z_max = std::clamp(parameters.real("zmax", radius), -radius, radius);
    const double low = std::min(z_min, z_max);
    const double high = std::max(z_min, z_max);
    const double bottom = std::acos(low / radius);
    const double top = std::acos(high / radius);
    const auto evaluate = [&](double u, double v) {
        const double theta = bottom + v * (top - bottom);
        const auto [cosine, sine] = direction(u, sweep);
        const bool is_pole = (v == 0 && low == -radius) || (v == 1 && high == radius);
        const double rho = is_pole ? 0 : std::sin(theta);
        const Double3 normal = {rho * cosine, rho * sine, std::cos(theta)};
        return SurfacePoint{radius * normal, normal};
    };
    Mesh mesh = tessellate(shape, pieces(sweep, sides(shape)), pieces(bottom - top, sides(shape)), evaluate);
    const double scale = std::sqrt(area_ratio(shape, mesh, sweep * radius * (high - low)));
    for (Float3& p : mesh.positions) p = to_float(scale * to_double(p));
    return mesh;
}

Mesh read_disk(ShapeDirective& shape) {
    ParameterList& parameters = shape.parameters;
    const double radius = positive_radius(shape);
    const double inner_radius = parameters.real("innerradius", 0);
    const double height = parameters.real("height", 0);
    const double sweep = sweep_angle(shape);
    if (!(inner_radius >= 0 && inner_radius < radius))
        throw SceneError(parameters.location_of("innerradius"),
                         "shape \"disk\": innerradius must be at least 0 and less than the radius, found " +
                             to_text(inner_radius));
    const auto evaluate = [&](double u, double v) {
        const auto [cosine, sine] = direction(u, sweep);
        const double rho = radius + v * (inner_radius - radius);
        return SurfacePoint{{rho * cosine, rho * sine, height}, {0, 0, 1}};
    };
    Mesh mesh = tessellate(shape, pieces(sweep, sides(shape, kDiskLightSides)), 1, evaluate);
    const double exact_area = 0.5 * sweep * (radius * radius - inner_radius * inner_radius);
    const double scale = std::sqrt(area_ratio(shape, mesh, exact_area));
    for (Float3& p : mesh.positions) p = to_float({scale * p.x, scale * p.y, height});
    return mesh;
}

Mesh read_cylinder(ShapeDirective& shape) {
    ParameterList& parameters = shape.parameters;
    const double radius = positive_radius(shape);
    const double sweep = sweep_angle(shape);
    const double low = parameters.real("zmin", -1);
    const double high = parameters.real("zmax", 1);
    const auto evaluate = [&](double u, double v) {
        const auto [cosine, sine] = direction(u, sweep);
        return SurfacePoint{{radius * cosine, radius * sine, low + v * (high - low)}, {cosine, sine, 0}};
    };
    Mesh mesh = tessellate(shape, pieces(sweep, sides(shape)), 1, evaluate);
    const double scale = area_ratio(shape, mesh, sweep * radius * std::fabs(high - low));
    for (Float3& p : mesh.positions) p = to_float({scale * p.x, scale * p.y, p.z});
    return mesh;
}

} // namespace nusselt::scene
