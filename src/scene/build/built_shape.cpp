#include "scene/build/built_shape.h"

#include "scene/model/scene_size.h"

#include <malloc.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tbb/parallel_for.h>
#include <utility>

namespace nusselt::scene {

namespace {

template <class Light>
std::size_t count_of(const std::vector<BuiltShape>& shapes) {
    std::size_t sum = 0;
    for (const BuiltShape& shape : shapes) sum += shape.lights.of<Light>().size();
    return sum;
}

/// Shifts the indices of each shape by the vertices, lights and emitters of the shapes before it.
void renumber(std::vector<BuiltShape>& shapes, std::string_view copies) {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t polygons = 0;
    std::size_t round_lights = count_of<PolygonLight>(shapes); // they are numbered after all polygons
    std::size_t emitters = 0;
    std::size_t textures = 0;
    std::size_t profiles = 0;
    for (BuiltShape& shape : shapes) {
        const auto first_vertex = static_cast<std::uint32_t>(vertices);
        const auto first_polygon = static_cast<std::int32_t>(polygons);
        const auto polygon_count =
            static_cast<std::int32_t>(std::as_const(shape.lights).of<PolygonLight>().size());
        const auto first_round = static_cast<std::int32_t>(round_lights) - polygon_count;
        const auto first_emitter = static_cast<std::uint32_t>(emitters);
        const auto first_texture = static_cast<std::int32_t>(textures);
        const auto first_profile = static_cast<std::int32_t>(profiles);
        vertices += shape.positions.size();
        triangles += shape.triangles.size();
        polygons += static_cast<std::size_t>(polygon_count);
        round_lights += std::as_const(shape.lights).of<RoundLight>().size();
        emitters += shape.emitters.size();
        textures += shape.emission_textures.size();
        profiles += shape.emission_profiles.size();
        check_counts(vertices, triangles, copies);
        if (first_vertex > 0)
            for (Triangle& triangle : shape.triangles)
                for (std::uint32_t& vertex : triangle.vertex) vertex += first_vertex;
        for (std::int32_t& light : shape.triangle_light)
            if (light >= 0) light += light < polygon_count ? first_polygon : first_round;
        if (first_texture > 0 && !shape.emission_textures.empty()) {
            const auto renumber_textures = [&](auto& list) {
                for (auto& light : list)
                    if (light.texture >= 0) light.texture += first_texture;
            };
            renumber_textures(shape.lights.of<PolygonLight>());
            renumber_textures(shape.lights.of<LineLight>());
        }
        if (first_profile > 0 && !shape.emission_profiles.empty()) {
            const auto renumber_profiles = [&](auto& list) {
                for (auto& light : list)
                    if (light.profile >= 0) light.profile += first_profile;
            };
            renumber_profiles(shape.lights.of<PolygonLight>());
            renumber_profiles(shape.lights.of<LineLight>());
        }
        if (first_emitter > 0)
            for (LightList& list : shape.lights)
                for (std::size_t i = 0; i < list.size(); ++i) list.emitter(i) += first_emitter;
    }
}

/// After the parts of a large array were released: returns their memory to the system. The heap keeps freed arrays of up to
/// 32 MiB, also if nothing that is allocated later fits into the gaps.
void return_parts(std::size_t bytes) {
    constexpr std::size_t kManyBytes = std::size_t{1} << 20;
    if (bytes > kManyBytes) ::malloc_trim(0);
}

/// Joins the arrays of the shapes, and releases them.
/// \param sizes    the number of elements of each shape in the result
/// \param missing  the value of elements of shapes without this array
/// \returns an empty array if no shape has this one
template <class T, class Owner>
std::vector<T> take_arrays(std::vector<BuiltShape>& shapes, std::vector<T> Owner::*array,
                           const std::vector<std::size_t>& sizes, const T& missing) {
    const auto is_missing = [&](const BuiltShape& shape) { return (shape.*array).empty(); };
    if (std::all_of(shapes.begin(), shapes.end(), is_missing)) return {};
    std::vector<std::size_t> offsets(shapes.size());
    std::exclusive_scan(sizes.begin(), sizes.end(), offsets.begin(), std::size_t{0});
    const std::size_t total = offsets.back() + sizes.back();
    for (BuiltShape& shape : shapes)
        if ((shape.*array).size() == total) return std::exchange(shape.*array, {});
    std::vector<T> result(total, missing);
    tbb::parallel_for(std::size_t{0}, shapes.size(), [&](std::size_t i) {
        const std::vector<T> part = std::exchange(shapes[i].*array, {});
        std::copy(part.begin(), part.end(), result.begin() + static_cast<std::ptrdiff_t>(offsets[i]));
    });
    return_parts(total * sizeof(T));
    return result;
}

} // namespace

BuiltShape join(std::vector<BuiltShape> shapes, std::string_view copies) {
    renumber(shapes, copies);
    const std::vector<std::size_t> vertices = sizes_of(shapes, &BuiltShape::positions);
    const std::vector<std::size_t> triangles = sizes_of(shapes, &BuiltShape::triangles);
    BuiltShape result;
    result.positions = take_arrays(shapes, &BuiltShape::positions, vertices, {});
    result.normals = take_arrays(shapes, &BuiltShape::normals, vertices, {0, 0, 0});
    result.uvs = take_arrays(shapes, &BuiltShape::uvs, vertices, {0, 0});
    result.triangles = take_arrays(shapes, &BuiltShape::triangles, triangles, {});
    result.triangle_light = take_arrays(shapes, &BuiltShape::triangle_light, triangles, -1);
    result.triangle_material = take_arrays(shapes, &BuiltShape::triangle_material, triangles, {});
    result.emitters = take_arrays(shapes, &BuiltShape::emitters, sizes_of(shapes, &BuiltShape::emitters), {});
    result.emission_textures = take_arrays(shapes, &BuiltShape::emission_textures,
                                           sizes_of(shapes, &BuiltShape::emission_textures), {});
    result.emission_profiles = take_arrays(shapes, &BuiltShape::emission_profiles,
                                           sizes_of(shapes, &BuiltShape::emission_profiles), {});
    std::vector<Lights> lights;
    lights.reserve(shapes.size());
    for (BuiltShape& shape : shapes) lights.push_back(std::move(shape.lights));
    result.lights.append(std::move(lights));
    for (const BuiltShape& shape : shapes) {
        result.degenerate_triangles += shape.degenerate_triangles;
        if (!result.first_degenerate) result.first_degenerate = shape.first_degenerate;
        result.round_shapes += shape.round_shapes;
        result.warnings.append(shape.warnings);
    }
    std::size_t light_bytes = 0;
    for (const LightList& list : std::as_const(result.lights)) light_bytes += list.bytes();
    return_parts(light_bytes);
    return result;
}

} // namespace nusselt::scene
