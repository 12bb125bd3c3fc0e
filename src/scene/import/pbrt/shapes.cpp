#include "scene/import/pbrt/shapes.h"

#include "scene/build/mesh_lights.h"
#include "scene/import/pbrt/name_table.h"
#include "scene/import/pbrt/shape_readers.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

namespace nusselt::scene {

namespace {

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

/// Renderers normalise normals in float, so their squares must not vanish there.
void remove_degenerate_triangles(Mesh& mesh) {
    const auto is_degenerate = [&](const Triangle& triangle) {
        const Double3 p0 = to_double(mesh.positions[triangle.vertex[0]]);
        const Double3 normal = cross(to_double(mesh.positions[triangle.vertex[1]]) - p0,
                                     to_double(mesh.positions[triangle.vertex[2]]) - p0);
        return dot(normal, normal) < static_cast<double>(std::numeric_limits<float>::min());
    };
    mesh.degenerate_triangles += std::erase_if(mesh.triangles, is_degenerate);
}

using Reader = Mesh (*)(ShapeDirective&);
constexpr std::pair<std::string_view, Reader> kReaders[] = {{"trianglemesh", read_triangle_mesh},
                                                            {"plymesh", read_ply_mesh},
                                                            {"loopsubdiv", read_loop_subdivision},
                                                            {"bilinearmesh", read_bilinear_mesh},
                                                            {"quad", read_quad},
                                                            {"polygon", read_polygon},
                                                            {"sphere", read_sphere},
                                                            {"disk", read_disk},
                                                            {"cylinder", read_cylinder},
                                                            {"line", read_tube}};

Mesh build_surface(ShapeDirective& shape) {
    Mesh mesh = find_named(kReaders, shape.type)(shape);
    move_to_world(shape, mesh);
    remove_degenerate_triangles(mesh);
    if (!is_black(shape.emission.radiance) && !mesh.triangles.empty()) add_polygon_lights(shape, mesh);
    return mesh;
}

} // namespace

bool is_supported(std::string_view type) { return find_named(kReaders, type) != nullptr; }

void limit_tessellation(std::vector<ShapeDirective>& shapes) {
    const auto is_round = [](const ShapeDirective& shape) {
        return shape.type == "sphere" || shape.type == "disk" || shape.type == "cylinder" ||
               shape.type == "bilinearmesh";
    };
    constexpr double kFineShapes = 1000; // may have all sides
    constexpr int kFewest = 8;
    const auto count = static_cast<double>(std::count_if(shapes.begin(), shapes.end(), is_round));
    if (count <= kFineShapes) return;
    for (ShapeDirective& shape : shapes)
        shape.max_sides =
            std::max(kFewest, static_cast<int>(shape.max_sides * std::sqrt(kFineShapes / count)));
}

bool flips_orientation(const ShapeDirective& shape) {
    return shape.reverse_orientation != (linear_determinant(shape.world_from_object) < 0);
}

Mesh build_mesh(ShapeDirective& shape) {
    Mesh mesh = is_tube(shape) ? read_tube(shape) : build_surface(shape);
    shape.parameters.warn_unused("shape \"" + shape.type + '"', mesh.warnings);
    return mesh;
}

} // namespace nusselt::scene
