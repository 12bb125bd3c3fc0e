#include "scene/build/lights/round_light.h"
#include "scene/build/tessellate.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

namespace nusselt::scene {

namespace {

// Pieces around the full circle. Lights cost time per piece; those of a disk are merged to few polygons.
constexpr int kLightSides = 16;
constexpr int kDiskLightSides = 32;

/// A point of a surface at parameters (u, v) in [0, 1]^2, with the normal (d/du) x (d/dv).
struct SurfacePoint {
    Double3 position;
    Double3 normal;
};

double radians(double sweep_degrees) {
    return std::clamp(sweep_degrees, 0.0, 360.0) * (std::numbers::pi / 180);
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
    // Quads at poles are triangles.
    if (!are_equal(a, b) && !are_equal(b, c) && !are_equal(c, a)) mesh.triangles.push_back({{a, b, c}});
}

struct Pieces {
    int columns, rows;
};

/// \param evaluate  maps u and v to a SurfacePoint
template <class Surface>
Mesh grid(const Pieces& pieces, const Surface& evaluate) {
    const auto [columns, rows] = pieces;
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
    return mesh;
}

bool emits(const ShapeDescription& shape) { return !is_black(shape.emission.radiance); }

/// Why a shape that emits is no light of its own shape; empty for others.
std::string reason_of(const PlacedShape& placed) {
    const ShapeDescription& shape = *placed.shape;
    if (!emits(shape) || std::holds_alternative<Cylinder>(shape.geometry)) return "";
    return ", because " +
           std::string(why_not_round(shape.geometry, shape.emission, placed.world_from_object));
}

/// \param consequence  continues the sentence
void warn(const PlacedShape& placed, const Pieces& pieces, const std::string& consequence,
          Warnings& warnings) {
    const ShapeDescription& shape = *placed.shape;
    const std::string reason = reason_of(placed);
    warnings.add(shape.origin, std::string(shape.kind) + (emits(shape) ? " that emits" : "") + reason,
                 subject_of(shape) + ": approximated by " + std::to_string(pieces.columns) + " x " +
                     std::to_string(pieces.rows) + " flat pieces of the same area" + reason + consequence);
}

/// Each piece of a curved surface is a light of its own, because no two lie in one plane.
void warn_of_curved(const PlacedShape& placed, const Pieces& pieces, Warnings& warnings) {
    const std::string count = std::to_string(pieces.columns * pieces.rows);
    warn(placed, pieces,
         emits(*placed.shape)
             ? ": " + count + " lights, which cost up to " + count + " times as much as one quad"
             : "",
         warnings);
}

/// The ratio of the exact area to that of a tessellation. Throws SceneError if one of them is zero.
double area_ratio(const ShapeDescription& shape, const Mesh& mesh, double exact_area) {
    const double flat_area = area(mesh);
    if (!(exact_area > 0) || !(flat_area > 0))
        throw SceneError(shape.origin, subject_of(shape) + ": its area is zero");
    return exact_area / flat_area;
}

/// (cosine, sine). They are exactly periodic, so that the ends of a full circle coincide.
std::pair<double, double> direction(double u, double sweep) {
    const double angle = u == 1 && sweep == 2 * std::numbers::pi ? 0 : u * sweep;
    return {std::cos(angle), std::sin(angle)};
}

int sides(const PlacedShape& placed, int light_sides = kLightSides) {
    return emits(*placed.shape) ? std::min(light_sides, placed.max_sides) : placed.max_sides;
}

} // namespace

Mesh tessellate(const Sphere& sphere, const PlacedShape& placed, Warnings& warnings) {
    const double radius = sphere.radius;
    const double sweep = radians(sphere.sweep_degrees);
    const double z_min = std::clamp(sphere.z_min, -radius, radius);
    const double z_max = std::clamp(sphere.z_max, -radius, radius);
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
    const int per_circle = sides(placed);
    const Pieces division = {pieces(sweep, per_circle), pieces(bottom - top, per_circle)};
    Mesh mesh = grid(division, evaluate);
    warn_of_curved(placed, division, warnings);
    const double scale = std::sqrt(area_ratio(*placed.shape, mesh, sweep * radius * (high - low)));
    for (Float3& p : mesh.positions) p = to_float(scale * to_double(p));
    return mesh;
}

Mesh tessellate(const Disk& disk, const PlacedShape& placed, Warnings& warnings) {
    const double radius = disk.radius;
    const double inner_radius = disk.inner_radius;
    const double sweep = radians(disk.sweep_degrees);
    const auto evaluate = [&](double u, double v) {
        const auto [cosine, sine] = direction(u, sweep);
        const double rho = radius + v * (inner_radius - radius);
        return SurfacePoint{{rho * cosine, rho * sine, disk.height}, {0, 0, 1}};
    };
    const Pieces division = {pieces(sweep, sides(placed, kDiskLightSides)), 1};
    Mesh mesh = grid(division, evaluate);
    warn(placed, division, "", warnings);
    const double exact_area = 0.5 * sweep * (radius * radius - inner_radius * inner_radius);
    const double scale = std::sqrt(area_ratio(*placed.shape, mesh, exact_area));
    for (Float3& p : mesh.positions) p = to_float({scale * p.x, scale * p.y, disk.height});
    return mesh;
}

Mesh tessellate(const Cylinder& cylinder, const PlacedShape& placed, Warnings& warnings) {
    const double radius = cylinder.radius;
    const double sweep = radians(cylinder.sweep_degrees);
    const double low = cylinder.z_min;
    const double high = cylinder.z_max;
    const auto evaluate = [&](double u, double v) {
        const auto [cosine, sine] = direction(u, sweep);
        return SurfacePoint{{radius * cosine, radius * sine, low + v * (high - low)}, {cosine, sine, 0}};
    };
    const Pieces division = {pieces(sweep, sides(placed)), 1};
    Mesh mesh = grid(division, evaluate);
    warn_of_curved(placed, division, warnings);
    const double scale = area_ratio(*placed.shape, mesh, sweep * radius * std::fabs(high - low));
    for (Float3& p : mesh.positions) p = to_float({scale * p.x, scale * p.y, p.z});
    return mesh;
}

} // namespace nusselt::scene
