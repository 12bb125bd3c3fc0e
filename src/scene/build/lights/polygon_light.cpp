#include "scene/build/lights/polygon_light.h"

#include "scene/build/lights/emission_warnings.h"
#include "scene/build/lights/profiled_light.h"
#include "scene/build/lights/textured_light.h"
#include "scene/build/polygons/polygon_merge.h"
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

void add_uniform_polygons(const ShapeDescription& shape, const FormatWords& words,
                          PolygonPartition&& partition, BuiltShape& built) {
    const Emission emission = without_texture(shape.emission);
    if (is_black(emission.radiance)) {
        make_dark(shape, black_image(shape.emission.texture->name), built);
        return;
    }
    if (shape.emission.texture != nullptr)
        built.warnings.add(shape.origin, "image without texture coordinates",
                           subject_of(shape) +
                               ": without texture coordinates, the mean colour of the image is emitted");
    const Float3 radiance = radiance_of(emission, area(built), words.emission, shape.origin);
    built.triangle_light = std::move(partition.polygon_of_triangle);
    std::vector<PolygonLight>& lights = built.lights.of<PolygonLight>();
    lights.reserve(partition.polygons.size());
    for (PolygonVertices& polygon : partition.polygons)
        lights.push_back(
            {.vertices = std::move(polygon), .radiance = radiance, .two_sided = shape.emission.two_sided});
}

} // namespace

void add_polygon_lights(const ShapeDescription& shape, const FormatWords& words, ShownImages& images,
                        BuiltShape& built) {
    orient_by_shading_normals(built);
    PolygonPartition partition = merge_coplanar_triangles(built.positions, built.triangles);
    if (shape.emission.profile != nullptr)
        add_profiled_polygons(shape, words, std::move(partition), built);
    else if (shape.emission.texture != nullptr && !built.uvs.empty())
        add_textured_polygons(shape, words, std::move(partition), images, built);
    else
        add_uniform_polygons(shape, words, std::move(partition), built);
    if (shape.is_invisible) remove_surface(built);
}

void remove_surface(BuiltShape& built) {
    built.positions = {};
    built.normals = {};
    built.uvs = {};
    built.triangles = {};
    built.triangle_light = {};
}

} // namespace nusselt::scene
