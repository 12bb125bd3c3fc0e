#include "scene/build/mesh_lights.h"

#include "scene/model/light_area.h"
#include "scene/model/polygon.h"
#include "scene/model/vector_math.h"

#include <utility>

namespace nusselt::scene {

namespace {

Double3 right_hand_normal(const Mesh& mesh, const Triangle& triangle) {
    const Double3 p0 = to_double(mesh.positions[triangle.vertex[0]]);
    return cross(to_double(mesh.positions[triangle.vertex[1]]) - p0,
                 to_double(mesh.positions[triangle.vertex[2]]) - p0);
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

} // namespace

void add_polygon_lights(ShapeDirective& shape, Mesh& mesh) {
    orient_by_shading_normals(mesh);
    const Float3 radiance = radiance_of(shape.emission, area(mesh), shape.parameters.location());
    PolygonPartition partition = merge_coplanar_triangles(mesh.positions, mesh.triangles);
    mesh.triangle_light = std::move(partition.polygon_of_triangle);
    mesh.polygon_lights.reserve(partition.polygons.size());
    for (const PolygonVertices& polygon : partition.polygons)
        mesh.polygon_lights.push_back({0, polygon, radiance, shape.emission.two_sided});
    if (shape.parameters.real("alpha", 1) != 0) return;
    mesh.positions = {};
    mesh.normals = {};
    mesh.uvs = {};
    mesh.triangles = {};
    mesh.triangle_light = {};
}

} // namespace nusselt::scene
