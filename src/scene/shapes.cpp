#include "scene/shapes.h"

#include "scene/ply.h"
#include "scene/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace nusselt::scene {

namespace {

/// Whether pbrt's normal is the reverse of the right-hand normal of the vertices in world space.
bool flips_orientation(const ShapeDirective& shape) {
    return shape.reverse_orientation != (linear_determinant(shape.world_from_object) < 0);
}

std::string emitter_name(const ShapeDirective& shape) {
    return shape.type + " at " + to_string(shape.parameters.location());
}

/// Triangle fan around the first vertex.
std::vector<Triangle> fan(std::size_t vertices) {
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 1; i + 1 < vertices; ++i) triangles.push_back({{0, i, i + 1}});
    return triangles;
}

void check_length(const ShapeDirective& shape, std::string_view name, std::size_t found,
                  std::size_t expected) {
    if (found != 0 && found != expected)
        throw SceneError(shape.parameters.location_of(name),
                         "shape \"" + shape.type + "\": " + std::to_string(found) + " values of \"" +
                             std::string(name) + "\" for " + std::to_string(expected) + " vertices");
}

Mesh read_triangle_mesh(ShapeDirective& shape) {
    ParameterList& parameters = shape.parameters;
    Mesh mesh;
    mesh.positions = parameters.points("P");
    if (mesh.positions.empty())
        throw SceneError(parameters.location(), "shape \"trianglemesh\": parameter \"point3 P\" is missing");
    mesh.normals = parameters.points("N");
    mesh.uvs = parameters.pairs("uv");
    if (mesh.uvs.empty()) mesh.uvs = parameters.pairs("st");
    check_length(shape, "N", mesh.normals.size(), mesh.positions.size());
    check_length(shape, "uv", mesh.uvs.size(), mesh.positions.size());

    const std::vector<std::uint32_t> indices = parameters.indices("indices", mesh.positions.size());
    if (indices.empty()) {
        // As in pbrt v4, three vertices need no indices.
        if (mesh.positions.size() != 3)
            throw SceneError(parameters.location(),
                             "shape \"trianglemesh\": parameter \"integer indices\" is missing");
        mesh.triangles = fan(3);
    } else if (indices.size() % 3 != 0) {
        throw SceneError(parameters.location_of("indices"),
                         "shape \"trianglemesh\": the number of indices, " + std::to_string(indices.size()) +
                             ", is not a multiple of 3");
    }
    mesh.triangles.reserve(indices.size() / 3);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        mesh.triangles.push_back({{indices[i], indices[i + 1], indices[i + 2]}});
    parameters.ignore({"S", "faceIndices"});
    return mesh;
}

Mesh read_ply_mesh(ShapeDirective& shape) {
    ParameterList& parameters = shape.parameters;
    if (parameters.string("filename", "").empty())
        throw SceneError(parameters.location(),
                         "shape \"plymesh\": parameter \"string filename\" is missing");
    try {
        return read_ply(FileBytes(shape.mesh_path).view());
    } catch (const std::runtime_error& error) {
        throw SceneError(parameters.location_of("filename"),
                         "mesh file '" + shape.mesh_path.string() + "': " + error.what());
    }
}

Mesh read_quad(ShapeDirective& shape) {
    ParameterList& parameters = shape.parameters;
    const auto o = parameters.point("o");
    const auto u = parameters.point("u");
    const auto v = parameters.point("v");
    if (!o || !u || !v)
        throw SceneError(parameters.location(),
                         "shape \"quad\": needs the parameters \"point o\", \"vector u\" and \"vector v\"");
    const Double3 origin = to_double(*o);
    const Double3 along_u = origin + to_double(*u);
    Mesh mesh;
    mesh.positions = {*o, to_float(along_u), to_float(along_u + to_double(*v)),
                      to_float(origin + to_double(*v))};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = fan(4);
    return mesh;
}

Mesh read_polygon(ShapeDirective& shape) {
    Mesh mesh;
    mesh.positions = shape.parameters.points("P");
    std::vector<Double3> vertices;
    for (const Float3& p : mesh.positions) vertices.push_back(to_double(p));
    if (const auto defect = find_polygon_defect(vertices))
        throw SceneError(shape.parameters.location_of("P"), "shape \"polygon\": " + *defect);
    mesh.triangles = fan(mesh.positions.size());
    return mesh;
}

LineLight light_of_line(ShapeDirective& shape) {
    ParameterList& parameters = shape.parameters;
    std::vector<Float3> ends = parameters.points("P");
    for (const std::string_view name : {"p0", "p1"})
        if (const auto end = parameters.point(name)) ends.push_back(*end);
    if (ends.size() != 2)
        throw SceneError(
            parameters.location(),
            "shape \"line\": needs the parameters \"point3 p0\", \"point3 p1\" and \"float radius\"");
    const double scale = std::cbrt(std::fabs(linear_determinant(shape.world_from_object)));

    LineLight line;
    line.model = parameters.boolean("finite", true) ? TubeModel::solid : TubeModel::linear;
    line.begin = to_float(transform_point(shape.world_from_object, to_double(ends[0])));
    line.end = to_float(transform_point(shape.world_from_object, to_double(ends[1])));
    line.radius = static_cast<float>(parameters.real("radius", 0) * scale);
    return line;
}

/// By how much a transform scales the cross section of a cylinder around the z axis. Throws SceneError if that does not
/// stay round, or if the axis does not stay perpendicular to it.
double cross_section_scale(const ShapeDirective& shape) {
    const Double3 x = transform_vector(shape.world_from_object, {1, 0, 0});
    const Double3 y = transform_vector(shape.world_from_object, {0, 1, 0});
    const Double3 z = transform_vector(shape.world_from_object, {0, 0, 1});
    // Scene files round angles and matrices to a few digits.
    constexpr double kTolerance = 1e-3;
    const double scale = std::sqrt(length(x) * length(y));
    const bool is_round = std::fabs(length(x) - length(y)) <= kTolerance * scale &&
                          std::fabs(dot(x, y)) <= kTolerance * scale * scale;
    const double across = std::max(std::fabs(dot(x, z)), std::fabs(dot(y, z)));
    if (!is_round || across > kTolerance * scale * length(z))
        throw SceneError(shape.parameters.location(),
                         "shape \"cylinder\": the transform scales its cross section by " +
                             to_text(length(x)) + " along x and " + to_text(length(y)) +
                             " along y or shears it; it must stay a cylinder");
    return scale;
}

LineLight light_of_cylinder(ShapeDirective& shape, Warnings& warnings) {
    ParameterList& parameters = shape.parameters;
    if (const double phi_max = parameters.real("phimax", 360); phi_max != 360)
        throw SceneError(parameters.location_of("phimax"),
                         "shape \"cylinder\": phimax must be 360, found " + to_text(phi_max));
    if (shape.reverse_orientation)
        warnings.add(parameters.location(),
                     "shape \"cylinder\": ReverseOrientation is ignored, it emits outwards");

    LineLight line;
    line.model = TubeModel::solid;
    const double z_min = parameters.real("zmin", -1);
    const double z_max = parameters.real("zmax", 1);
    line.begin = to_float(transform_point(shape.world_from_object, {0, 0, z_min}));
    line.end = to_float(transform_point(shape.world_from_object, {0, 0, z_max}));
    line.radius = static_cast<float>(parameters.real("radius", 1) * cross_section_scale(shape));
    return line;
}

Mesh build_tube(ShapeDirective& shape) {
    Mesh mesh;
    ParameterList& parameters = shape.parameters;
    LineLight line = shape.type == "line" ? light_of_line(shape) : light_of_cylinder(shape, mesh.warnings);
    line.radiance = shape.emission.radiance;
    const std::string subject = "shape \"" + shape.type + "\": ";
    if (!is_valid_coordinate(line.begin) || !is_valid_coordinate(line.end))
        throw SceneError(parameters.location(), subject + "an end point is not finite or beyond 1e15 m");
    const double given = parameters.real("radius", line.radius);
    if (!(given > 0))
        throw SceneError(parameters.location_of("radius"),
                         subject + "radius must be positive, found " + to_text(given));
    if (!(line.radius > 0) || !is_valid_coordinate({line.radius, 0, 0}))
        throw SceneError(parameters.location_of("radius"),
                         subject + "radius must be positive and at most 1e15 m after the transform, found " +
                             to_text(line.radius));
    if (!(length(to_double(line.end) - to_double(line.begin)) > 0))
        throw SceneError(parameters.location(), subject + "both end points are equal");

    if (is_black(line.radiance)) {
        mesh.warnings.add(parameters.location(), subject + "ignored where it does not emit light");
    } else {
        mesh.line_lights = {line};
        mesh.emitter_name = emitter_name(shape);
    }
    parameters.warn_unused("shape \"" + shape.type + '"', mesh.warnings);
    return mesh;
}

void move_to_world(const ShapeDirective& shape, Mesh& mesh) {
    const Transform& transform = shape.world_from_object;
    if (!is_identity(transform)) {
        for (Float3& p : mesh.positions) p = to_float(transform_point(transform, to_double(p)));
        for (Float3& n : mesh.normals) n = to_float(transform_normal(transform, to_double(n)));
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (is_valid_coordinate(mesh.positions[i])) continue;
        const Float3& p = mesh.positions[i];
        throw SceneError(shape.parameters.location(), "shape \"" + shape.type + "\": vertex " +
                                                          std::to_string(i) + " at (" + to_text(p.x) + ", " +
                                                          to_text(p.y) + ", " + to_text(p.z) +
                                                          ") is not finite or beyond 1e15 m");
    }
    for (Float3& n : mesh.normals) {
        if (shape.reverse_orientation) n = {-n.x, -n.y, -n.z};
        // Meshes come with broken normals; the geometric one is better than NaN.
        if (!is_valid_coordinate(n)) n = {0, 0, 0};
    }
    constexpr float kMaxTextureCoordinate = 1e6f;
    for (Float2& uv : mesh.uvs)
        if (!(std::fabs(uv.x) <= kMaxTextureCoordinate && std::fabs(uv.y) <= kMaxTextureCoordinate))
            uv = {0, 0};
    if (flips_orientation(shape))
        for (Triangle& triangle : mesh.triangles) std::swap(triangle.vertex[1], triangle.vertex[2]);
}

Double3 right_hand_normal(const Mesh& mesh, const Triangle& triangle) {
    const Double3 p0 = to_double(mesh.positions[triangle.vertex[0]]);
    return cross(to_double(mesh.positions[triangle.vertex[1]]) - p0,
                 to_double(mesh.positions[triangle.vertex[2]]) - p0);
}

/// Renderers normalise normals in float, so their squares must not vanish there.
void remove_degenerate_triangles(Mesh& mesh) {
    const auto is_degenerate = [&](const Triangle& triangle) {
        const Double3 normal = right_hand_normal(mesh, triangle);
        return dot(normal, normal) < static_cast<double>(std::numeric_limits<float>::min());
    };
    mesh.degenerate_triangles += std::erase_if(mesh.triangles, is_degenerate);
}

void orient_by_shading_normals(Mesh& mesh) {
    if (mesh.normals.empty()) return;
    for (Triangle& triangle : mesh.triangles) {
        Double3 shading;
        for (const std::uint32_t vertex : triangle.vertex)
            shading = shading + to_double(mesh.normals[vertex]);
        if (dot(shading, right_hand_normal(mesh, triangle)) < 0)
            std::swap(triangle.vertex[1], triangle.vertex[2]);
    }
}

void add_light(const ShapeDirective& shape, std::vector<Float3> vertices, Mesh& mesh) {
    PolygonLight& light = mesh.polygon_lights.emplace_back();
    light.vertices = std::move(vertices);
    light.radiance = shape.emission.radiance;
    light.two_sided = shape.emission.two_sided;
}

void add_polygon_lights(const ShapeDirective& shape, Mesh& mesh) {
    orient_by_shading_normals(mesh);
    mesh.triangle_light.resize(mesh.triangles.size());
    for (MergedPolygon& polygon : merge_coplanar_triangles(mesh.positions, mesh.triangles)) {
        for (const std::uint32_t triangle : polygon.triangles)
            mesh.triangle_light[triangle] = static_cast<std::int32_t>(mesh.polygon_lights.size());
        add_light(shape, std::move(polygon.vertices), mesh);
    }
    if (!mesh.polygon_lights.empty()) mesh.emitter_name = emitter_name(shape);
}

using Reader = Mesh (*)(ShapeDirective&);
constexpr std::pair<std::string_view, Reader> kReaders[] = {{"trianglemesh", read_triangle_mesh},
                                                            {"plymesh", read_ply_mesh},
                                                            {"quad", read_quad},
                                                            {"polygon", read_polygon}};

} // namespace

bool is_tube(std::string_view type) { return type == "line" || type == "cylinder"; }

bool is_supported(const ShapeDirective& shape) {
    // Cylinders are lights, not surfaces.
    if (shape.type == "cylinder") return !is_black(shape.emission.radiance);
    return shape.type == "line" ||
           std::any_of(std::begin(kReaders), std::end(kReaders),
                       [&](const auto& reader) { return reader.first == shape.type; });
}

Mesh build_mesh(ShapeDirective& shape) {
    if (is_tube(shape.type)) return build_tube(shape);
    const auto* const reader = std::find_if(std::begin(kReaders), std::end(kReaders),
                                            [&](const auto& entry) { return entry.first == shape.type; });
    Mesh mesh = reader->second(shape);
    move_to_world(shape, mesh);
    remove_degenerate_triangles(mesh);
    if (!is_black(shape.emission.radiance)) add_polygon_lights(shape, mesh);

    ParameterList& parameters = shape.parameters;
    parameters.warn_unused("shape \"" + shape.type + '"', mesh.warnings);
    return mesh;
}

} // namespace nusselt::scene
