#include "scene/rig/light_edit.h"

#include "scene/colour/colour_space.h"
#include "scene/model/bounds.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/polygon.h"
#include "scene/model/scene_size.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nusselt::scene {

namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kShared = kNobody - 1;

/// Whether a light that could have a surface has none, because its alpha is 0.
bool is_invisible(const EditableLight& light) {
    return is_surface(light) && light.triangles.empty() && !light.has_new_surface;
}

/// The emission of a part of a light.
struct Emission {
    Float3 value = {1, 1, 1};
    bool two_sided = false;
};

Emission emission_of(const Lights& parts) {
    for (const LightList& list : parts) {
        if (list.size() == 0) continue;
        const bool* const two_sided = list.two_sided(0);
        return {list.emission(0), two_sided != nullptr && *two_sided};
    }
    return {};
}

void set_emission(const Emission& emission, Lights& parts) {
    for (LightList& list : parts) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            list.emission(i) = emission.value;
            if (bool* const two_sided = list.two_sided(i)) *two_sided = emission.two_sided;
        }
    }
}

/// Whether both are single lights that differ at most in their emission.
bool have_same_shape(const Lights& a, const Lights& b) {
    if (a.size() != 1 || b.size() != 1) return false;
    for (const LightList& list : a)
        for (const LightList& other : b)
            if (list.size() == 1 && other.size() == 1) return list.same_shape(0, other, 0);
    return false;
}

/// The surface of a single part.
LightSurface surface_of(const EditableLight& light) {
    LightSurface surface;
    for (const LightList& list : light.parts)
        if (list.is_surface() && list.size() > 0) list.add_surface(0, surface);
    return surface;
}

bool emits(const EditableLight& light) { return light.is_enabled && !light.is_removed && !is_black(light); }

template <class Array, class Marks>
void erase_marked(Array& array, const Marks& marks) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < array.size(); ++i)
        if (!marks[i]) array[kept++] = array[i];
    array.resize(kept);
}

template <class Array>
void insert_at(Array& array, std::size_t position, const Array& values) {
    array.insert(array.begin() + static_cast<std::ptrdiff_t>(position), values.begin(), values.end());
}

} // namespace

std::vector<EditableLight> editable_lights(const Scene& scene) {
    std::vector<EditableLight> lights(scene.emitters.size());
    for (std::size_t i = 0; i < lights.size(); ++i) lights[i].name = scene.emitters[i].name;
    const std::vector<std::uint32_t> emitter_of = light_emitters(scene);
    std::uint32_t number = 0;
    for (const LightList& list : scene.lights) {
        for (std::size_t i = 0; i < list.size(); ++i, ++number) {
            EditableLight& light = lights[list.emitter(i)];
            if (light.parts.empty()) light.first_light = number;
            light.parts.append(list, i);
        }
    }
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        if (scene.triangle_light[i] < 0) continue;
        EditableLight& light = lights[emitter_of[static_cast<std::size_t>(scene.triangle_light[i])]];
        light.material = scene.triangle_material[i];
        light.triangles.push_back(static_cast<std::uint32_t>(i));
    }
    return lights;
}

bool is_surface(const EditableLight& light) { return surface_light_count(light.parts) > 0; }

bool is_black(const EditableLight& light) {
    for (const LightList& list : light.parts)
        for (std::size_t i = 0; i < list.size(); ++i)
            if (!is_black(list.emission(i))) return false;
    return true;
}

Double3 centroid(const EditableLight& light) {
    Moment moment;
    for (const LightList& list : light.parts) list.add_to(moment);
    return moment.centroid();
}

double luminous_power(const EditableLight& light, double scene_radius) {
    double sum = 0;
    for (const LightList& list : light.parts)
        for (std::size_t i = 0; i < list.size(); ++i)
            sum += luminance(
                per_channel_product(list.flux_per_emission(i, scene_radius), to_double(list.emission(i))));
    return sum;
}

const EmissionQuantity* quantity_of(const Lights& parts) {
    for (const LightList& list : parts)
        if (list.size() > 0) return &list.quantity();
    return nullptr;
}

bool LightEditor::replace_shape(EditableLight& light, const Lights& shape, std::uint32_t material) {
    if (have_same_shape(light.parts, shape)) return false;
    const bool stays_invisible = is_invisible(light);
    if (!is_surface(light)) light.material = material;
    unused_triangles_.insert(unused_triangles_.end(), light.triangles.begin(), light.triangles.end());
    light.triangles.clear();
    const Emission emission = emission_of(light.parts);
    light.parts = shape;
    set_emission(emission, light.parts);
    light.has_new_surface = is_surface(light) && !stays_invisible;
    return true;
}

void LightEditor::transform(EditableLight& light, const Transform& transform) {
    const auto move = [&](Float3& p) { p = to_float(transform_point(transform, to_double(p))); };
    for (LightList& list : light.parts) list.transform(transform);
    for (const std::uint32_t vertex : own_vertices(light)) {
        move(scene_.positions[vertex]);
        Float3& normal = scene_.normals[vertex];
        if (!is_black(normal)) normal = to_float(transform_normal(transform, to_double(normal)));
    }
}

/// Finds for each vertex the only light that uses it, if there is one.
void LightEditor::find_vertex_owners() {
    const std::vector<std::uint32_t> emitter_of = light_emitters(scene_);
    vertex_owner_.assign(scene_.positions.size(), kNobody);
    for (std::size_t i = 0; i < scene_.triangles.size(); ++i) {
        const std::int32_t light = scene_.triangle_light[i];
        // Vertices of surfaces that do not emit never belong to a light alone.
        const std::uint32_t user = light < 0 ? kShared : emitter_of[static_cast<std::size_t>(light)];
        for (const std::uint32_t vertex : scene_.triangles[i].vertex) {
            std::uint32_t& owner = vertex_owner_[vertex];
            owner = owner == kNobody || owner == user ? user : kShared;
        }
    }
}

/// The vertices of the surface in the scene, without repetitions. Copies those that other surfaces use, too.
std::vector<std::uint32_t> LightEditor::own_vertices(EditableLight& light) {
    if (light.triangles.empty()) return {};
    if (vertex_owner_.empty()) find_vertex_owners();
    const auto self = static_cast<std::uint32_t>(&light - lights_.data());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> copies; // vertex and its copy
    std::vector<std::uint32_t> vertices;
    for (const std::uint32_t triangle : light.triangles)
        for (const std::uint32_t vertex : scene_.triangles[triangle].vertex) vertices.push_back(vertex);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (std::uint32_t& vertex : vertices) {
        if (vertex_owner_[vertex] != kShared) continue;
        const auto copy = static_cast<std::uint32_t>(scene_.positions.size());
        copies.emplace_back(vertex, copy);
        scene_.positions.push_back(Float3(scene_.positions[vertex]));
        scene_.normals.push_back(Float3(scene_.normals[vertex]));
        scene_.uvs.push_back(Float2(scene_.uvs[vertex]));
        vertex_owner_.push_back(self);
        vertex = copy;
    }
    if (copies.empty()) return vertices;
    for (const std::uint32_t triangle : light.triangles) {
        for (std::uint32_t& vertex : scene_.triangles[triangle].vertex) {
            const auto copy = std::lower_bound(copies.begin(), copies.end(), std::pair(vertex, 0u));
            if (copy != copies.end() && copy->first == vertex) vertex = copy->second;
        }
    }
    return vertices;
}

void LightEditor::finish() {
    put_lights_back();
    remove_surfaces();
    add_surfaces();
    scene_.radius = scene_radius(scene_);
}

void LightEditor::put_lights_back() {
    scene_.emitters.clear();
    scene_.lights.clear();
    std::vector<std::int32_t> triangle_light(scene_.triangles.size(), -1);
    for (EditableLight& light : lights_) {
        if (!emits(light)) continue;
        const auto emitter = static_cast<std::uint32_t>(scene_.emitters.size());
        scene_.emitters.push_back({light.name});
        for (LightList& list : light.parts)
            for (std::size_t i = 0; i < list.size(); ++i) list.emitter(i) = emitter;
        scene_.lights.append(light.parts);
    }
    // A number is needed only for lights with triangles: polygons come first, then round lights.
    std::size_t polygons = 0;
    std::size_t round_lights = std::as_const(scene_.lights).of<PolygonLight>().size();
    for (EditableLight& light : lights_) {
        if (!emits(light) || !is_surface(light)) continue;
        const std::size_t polygon_count = std::as_const(light.parts).of<PolygonLight>().size();
        const std::size_t first_light = polygon_count > 0 ? polygons : round_lights;
        for (const std::uint32_t triangle : light.triangles)
            triangle_light[triangle] =
                scene_.triangle_light[triangle] +
                static_cast<std::int32_t>(static_cast<std::int64_t>(first_light) - light.first_light);
        light.first_light = static_cast<std::uint32_t>(first_light);
        polygons += polygon_count;
        round_lights += std::as_const(light.parts).of<RoundLight>().size();
    }
    scene_.triangle_light = std::move(triangle_light);
}

void LightEditor::remove_surfaces() {
    for (const EditableLight& light : lights_)
        if (light.is_removed)
            unused_triangles_.insert(unused_triangles_.end(), light.triangles.begin(), light.triangles.end());
    if (unused_triangles_.empty()) return;
    std::vector<char> is_unused(scene_.triangles.size(), 0);
    std::vector<Triangle> removed;
    for (const std::uint32_t triangle : unused_triangles_) {
        is_unused[triangle] = 1;
        removed.push_back(scene_.triangles[triangle]);
    }
    erase_marked(scene_.triangles, is_unused);
    erase_marked(scene_.triangle_material, is_unused);
    erase_marked(scene_.triangle_light, is_unused);
    // Triangles of lights come before those of objects.
    for (Object& object : scene_.objects) object.first_triangle -= static_cast<std::uint32_t>(removed.size());
    remove_vertices(removed);
}

void LightEditor::remove_vertices(const std::vector<Triangle>& removed) {
    std::vector<char> is_unused(scene_.positions.size(), 0);
    for (const Triangle& triangle : removed)
        for (const std::uint32_t vertex : triangle.vertex) is_unused[vertex] = 1;
    for (const Triangle& triangle : scene_.triangles)
        for (const std::uint32_t vertex : triangle.vertex) is_unused[vertex] = 0;
    std::vector<std::uint32_t> new_index(scene_.positions.size());
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < new_index.size(); ++i) {
        new_index[i] = count;
        count += is_unused[i] ? 0 : 1;
    }
    for (Triangle& triangle : scene_.triangles)
        for (std::uint32_t& vertex : triangle.vertex) vertex = new_index[vertex];
    erase_marked(scene_.positions, is_unused);
    erase_marked(scene_.normals, is_unused);
    erase_marked(scene_.uvs, is_unused);
}

void LightEditor::add_surfaces() {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> materials;
    std::vector<std::int32_t> triangle_light;
    for (const EditableLight& light : lights_) {
        if (!light.has_new_surface || light.is_removed) continue;
        const auto base = static_cast<std::uint32_t>(scene_.positions.size());
        const LightSurface surface = surface_of(light);
        insert_at(scene_.positions, scene_.positions.size(), surface.positions);
        insert_at(scene_.normals, scene_.normals.size(), surface.normals);
        insert_at(scene_.uvs, scene_.uvs.size(), surface.uvs);
        for (const Triangle& triangle : surface.triangles) {
            const auto& vertex = triangle.vertex;
            triangles.push_back({{base + vertex[0], base + vertex[1], base + vertex[2]}});
            materials.push_back(light.material);
            triangle_light.push_back(emits(light) ? static_cast<std::int32_t>(light.first_light) : -1);
        }
        check_counts(scene_.positions.size(), scene_.triangles.size() + triangles.size());
    }
    const std::size_t position = world_triangle_count(scene_);
    insert_at(scene_.triangles, position, triangles);
    insert_at(scene_.triangle_material, position, materials);
    insert_at(scene_.triangle_light, position, triangle_light);
    for (Object& object : scene_.objects)
        object.first_triangle += static_cast<std::uint32_t>(triangles.size());
}

} // namespace nusselt::scene
