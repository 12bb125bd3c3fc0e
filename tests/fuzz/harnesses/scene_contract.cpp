#include "scene_contract.h"

#include "files.h"
#include "scene/import/importers.h"
#include "scene/model/lights/light_kinds.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <tbb/global_control.h>

namespace nusselt::fuzz {

namespace {

using namespace scene;

/// Embree aborts the process at larger coordinates.
constexpr float kLargestCoordinate = 1e18f;

bool is_finite(const Float3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool is_finite(const Float2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool is_position(const Float3& v) {
    return std::fabs(v.x) <= kLargestCoordinate && std::fabs(v.y) <= kLargestCoordinate &&
           std::fabs(v.z) <= kLargestCoordinate;
}
bool is_radiance(const Float3& v) { return is_finite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0; }
bool is_index(std::int64_t index, std::size_t size) {
    return index >= 0 && index < static_cast<std::int64_t>(size);
}

template <class Array, class Predicate>
bool all(const Array& array, const Predicate& predicate) {
    return std::all_of(array.begin(), array.end(), predicate);
}

std::string_view violation_of_surfaces(const Scene& scene) {
    const std::size_t vertex_count = scene.positions.size();
    if (scene.normals.size() != vertex_count || scene.uvs.size() != vertex_count)
        return "arrays of vertices differ in length";
    const std::size_t triangle_count = scene.triangles.size();
    if (scene.triangle_material.size() != triangle_count || scene.triangle_light.size() != triangle_count)
        return "arrays of triangles differ in length";
    if (!all(scene.positions, is_position)) return "a position is not finite or too large";
    if (!all(scene.normals, [](const Float3& v) { return is_finite(v); })) return "a normal is not finite";
    if (!all(scene.uvs, [](const Float2& v) { return is_finite(v); }))
        return "a texture coordinate is not finite";
    for (std::size_t i = 0; i < triangle_count; ++i) {
        for (const std::uint32_t vertex : scene.triangles[i].vertex)
            if (!is_index(vertex, vertex_count)) return "a triangle has no such vertex";
        if (!is_index(scene.triangle_material[i], scene.materials.size()))
            return "a triangle has no such material";
        const std::int32_t light = scene.triangle_light[i];
        if (light != -1 && !is_index(light, scene::surface_light_count(scene.lights)))
            return "a triangle has no such light";
        if (light != -1 && i >= world_triangle_count(scene)) return "a triangle of an object emits";
    }
    return {};
}

std::string_view violation_of_objects(const Scene& scene) {
    std::size_t first = world_triangle_count(scene);
    for (const Object& object : scene.objects) {
        if (object.first_triangle != first) return "the triangles of objects do not follow each other";
        first += object.triangle_count;
    }
    if (first != scene.triangles.size()) return "objects and the world are not all triangles";
    for (const Instance& instance : scene.instances) {
        if (!is_index(instance.object, scene.objects.size())) return "an instance has no such object";
        if (!all(instance.world_from_object, [](float x) { return std::isfinite(x); }))
            return "the matrix of an instance is not finite";
    }
    return {};
}

std::string_view violation_of_materials(const Scene& scene) {
    const auto is_valid_use = [&](const TextureUse& use) {
        return (use.texture == -1 || is_index(use.texture, scene.textures.size())) && is_finite(use.scale) &&
               is_finite(use.offset);
    };
    for (const Material& material : scene.materials) {
        if (!is_finite(material.diffuse) || !is_finite(material.f0)) return "a colour is not finite";
        if (!(material.roughness >= 0 && material.roughness <= 1)) return "a roughness is not in [0, 1]";
        if (!(material.alpha >= 0 && material.alpha <= 1)) return "an alpha is not in [0, 1]";
        if (!std::isfinite(material.bump)) return "the height of a bump map is not finite";
        for (const TextureUse& use :
             {material.diffuse_texture, material.f0_texture, material.roughness_texture,
              material.alpha_texture, material.bump_texture, material.normal_texture})
            if (!is_valid_use(use)) return "a material has no such texture, or looks it up nowhere";
    }
    for (const Texture& texture : scene.textures) {
        if (texture.width <= 0 || texture.height <= 0) return "a texture is empty";
        if (texture.channels != 1 && texture.channels != 3) return "a texture has neither 1 nor 3 channels";
        if (texture.texels.size() != static_cast<std::size_t>(texture.channels) *
                                         static_cast<std::size_t>(texture.width) *
                                         static_cast<std::size_t>(texture.height))
            return "the number of texels does not fit the size of their texture";
        if (!all(texture.texels, [](float x) { return std::isfinite(x) && x >= 0; }))
            return "a texel is negative or not finite";
    }
    return {};
}

/// Checks that lights refer to emitters, in their order.
template <class Lights>
std::string_view violation_of_emitters(const Scene& scene, const Lights& lights) {
    if (!all(lights, [&](const auto& light) { return is_index(light.emitter, scene.emitters.size()); }))
        return "a light has no such emitter";
    const auto is_before = [](const auto& a, const auto& b) { return a.emitter < b.emitter; };
    return std::is_sorted(lights.begin(), lights.end(), is_before)
               ? std::string_view()
               : "lights are not in the order of their emitters";
}

std::string_view violation_of_lights(const Scene& scene) {
    for (const PolygonLight& light : scene.lights.of<scene::PolygonLight>()) {
        if (light.vertices.size() < 3 || light.vertices.size() > 8) return "a light has not 3 to 8 vertices";
        if (!all(light.vertices, is_position)) return "a vertex of a light is not finite or too large";
        if (!is_radiance(light.radiance)) return "a radiance is negative or not finite";
    }
    for (const LineLight& light : scene.lights.of<scene::LineLight>()) {
        if (!is_position(light.start) || !is_position(light.end))
            return "an end of a tube is not finite or too large";
        if (!(light.radius >= 0 && light.radius <= kLargestCoordinate)) return "a tube has no valid radius";
        if (!is_radiance(light.radiance)) return "a radiance is negative or not finite";
    }
    for (const std::string_view problem : {violation_of_emitters(scene, scene.lights.of<PolygonLight>()),
                                           violation_of_emitters(scene, scene.lights.of<LineLight>()),
                                           violation_of_emitters(scene, scene.lights.of<PointLight>()),
                                           violation_of_emitters(scene, scene.lights.of<DistantLight>())})
        if (!problem.empty()) return problem;
    return {};
}

std::string_view violation_of_light_sources(const Scene& scene) {
    const auto is_unit = [](const Float3& v) { return std::fabs(length(to_double(v)) - 1) < 1e-5; };
    for (const PointLight& light : scene.lights.of<PointLight>()) {
        if (!is_position(light.position)) return "a point light is not finite or too far away";
        if (!is_radiance(light.intensity)) return "an intensity is negative or not finite";
        if (!is_unit(light.x_axis) || !is_unit(light.y_axis) || !is_unit(light.z_axis))
            return "an axis of a point light has no unit length";
        if (!(light.cone_angle > 0 && light.cone_angle <= 180 && light.full_angle >= 0 &&
              light.full_angle <= light.cone_angle))
            return "the angles of a spot are out of range";
        if (light.texture != -1 && !is_index(light.texture, scene.textures.size()))
            return "a point light has no such texture";
        if (!(light.half_extent.x > 0 && light.half_extent.y > 0)) return "a projected image has no size";
    }
    for (const DistantLight& light : scene.lights.of<DistantLight>()) {
        if (!is_unit(light.direction)) return "a direction has no unit length";
        if (!is_radiance(light.irradiance)) return "an irradiance is negative or not finite";
    }
    return {};
}

std::string_view violation_of_view(const Scene& scene) {
    const Camera& camera = scene.camera;
    for (const Float3& v :
         {camera.origin, camera.origin_right, camera.origin_down, camera.corner, camera.right, camera.down})
        if (!is_finite(v)) return "the camera is not finite";
    const Film& film = scene.film;
    if (film.width <= 0 || film.height <= 0) return "the film is empty";
    if (film.crop) {
        const PixelBounds& crop = *film.crop;
        if (crop.x_begin < 0 || crop.x_begin >= crop.x_end || crop.x_end > film.width || crop.y_begin < 0 ||
            crop.y_begin >= crop.y_end || crop.y_end > film.height)
            return "the crop is empty or not in the film";
    }
    const PixelFilter& filter = film.filter;
    for (const float x : {filter.radius_x, filter.radius_y, filter.sigma})
        if (!(x > 0 && std::isfinite(x))) return "the filter has no positive size";
    if (!std::isfinite(filter.b) || !std::isfinite(filter.c)) return "the filter is not finite";
    return {};
}

} // namespace

std::string_view violation(const Scene& scene) {
    for (const auto check : {violation_of_surfaces, violation_of_objects, violation_of_materials,
                             violation_of_lights, violation_of_light_sources, violation_of_view})
        if (const std::string_view problem = check(scene); !problem.empty()) return problem;
    if (!(scene.radius >= 0 && std::isfinite(scene.radius))) return "the radius of the scene is not finite";
    for (const std::string& warning : scene.warnings)
        if (const std::string_view problem = problem_of_message(warning); !problem.empty()) return problem;
    return {};
}

void load_or_refuse(const std::filesystem::path& path) {
    static const tbb::global_control kOneThread(tbb::global_control::max_allowed_parallelism, 1);
    read_or_refuse([&] { fail_if_any(violation(load_scene(path))); });
}

} // namespace nusselt::fuzz
