#include "scene/rig/light_edit.h"

#include "scene/colour/colour_space.h"
#include "scene/model/bounds.h"
#include "scene/model/light_area.h"
#include "scene/model/polygon.h"
#include "scene/model/scene_size.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nusselt::scene {

namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kShared = kNobody - 1;

std::vector<Double3> corners(const PolygonLight& light) {
    std::vector<Double3> result;
    for (const Float3& p : light.vertices) result.push_back(to_double(p));
    return result;
}

bool equal(const Float3& a, const Float3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

bool has_shape(const EditableLight& light, const std::vector<Float3>& vertices) {
    if (light.polygons.size() != 1 || !light.tubes.empty()) return false;
    const auto& own = light.polygons[0].vertices;
    return std::equal(own.begin(), own.end(), vertices.begin(), vertices.end(), equal);
}

bool has_shape(const EditableLight& light, const TubeShape& tube) {
    if (light.tubes.size() != 1 || !light.polygons.empty()) return false;
    const LineLight& own = light.tubes[0];
    return equal(own.start, tube.start) && equal(own.end, tube.end) && own.radius == tube.radius &&
           own.model == tube.model;
}

void set_shape(EditableLight& light, const Float3& radiance, const std::vector<Float3>& vertices) {
    PolygonLight polygon;
    polygon.two_sided = !light.polygons.empty() && light.polygons[0].two_sided;
    polygon.radiance = radiance;
    polygon.vertices = vertices;
    light.polygons = {polygon};
    light.tubes.clear();
    light.has_new_surface = true;
}

void set_shape(EditableLight& light, const Float3& radiance, const TubeShape& shape) {
    LineLight tube;
    tube.start = shape.start;
    tube.end = shape.end;
    tube.radius = shape.radius;
    tube.model = shape.model;
    tube.radiance = radiance;
    light.polygons.clear();
    light.tubes = {tube};
    light.has_new_surface = false;
}

/// Alpha 0 makes lights without a surface.
bool is_invisible(const EditableLight& light) {
    return !light.polygons.empty() && light.triangles.empty() && !light.has_new_surface;
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
    for (std::size_t i = 0; i < scene.polygon_lights.size(); ++i) {
        EditableLight& light = lights[scene.polygon_lights[i].emitter];
        if (light.polygons.empty()) light.first_polygon = static_cast<std::uint32_t>(i);
        light.polygons.push_back(scene.polygon_lights[i]);
    }
    for (const LineLight& tube : scene.line_lights) lights[tube.emitter].tubes.push_back(tube);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        if (scene.triangle_light[i] < 0) continue;
        const auto polygon = static_cast<std::size_t>(scene.triangle_light[i]);
        EditableLight& light = lights[scene.polygon_lights[polygon].emitter];
        light.material = scene.triangle_material[i];
        light.triangles.push_back(static_cast<std::uint32_t>(i));
    }
    return lights;
}

bool is_black(const EditableLight& light) {
    const auto is_dark = [](const auto& part) { return is_black(part.radiance); };
    return std::all_of(light.polygons.begin(), light.polygons.end(), is_dark) &&
           std::all_of(light.tubes.begin(), light.tubes.end(), is_dark);
}

Double3 centroid(const EditableLight& light) {
    Double3 moment;
    double total = 0;
    const auto add = [&](double weight, const Double3& p) {
        moment = moment + weight * p;
        total += weight;
    };
    for (const PolygonLight& polygon : light.polygons) {
        const std::vector<Double3> p = corners(polygon);
        for (std::size_t i = 1; i + 1 < p.size(); ++i)
            add(0.5 * length(cross(p[i] - p[0], p[i + 1] - p[0])), (1.0 / 3) * (p[0] + p[i] + p[i + 1]));
    }
    for (const LineLight& tube : light.tubes)
        add(lateral_area(tube), 0.5 * (to_double(tube.start) + to_double(tube.end)));
    return (1 / total) * moment;
}

double luminous_power(const EditableLight& light) {
    double sum = 0;
    for (const PolygonLight& polygon : light.polygons)
        sum += (polygon.two_sided ? 2 : 1) * area(polygon) * luminance(to_double(polygon.radiance));
    for (const LineLight& tube : light.tubes) sum += area(tube) * luminance(to_double(tube.radiance));
    return std::numbers::pi * sum;
}

void LightEditor::replace_shape(EditableLight& light, const LightShape& shape, std::uint32_t material) {
    if (std::visit([&](const auto& s) { return has_shape(light, s); }, shape)) return;
    const bool stays_invisible = is_invisible(light);
    if (light.polygons.empty()) light.material = material;
    Float3 radiance = {1, 1, 1};
    if (!light.polygons.empty())
        radiance = light.polygons[0].radiance;
    else if (!light.tubes.empty())
        radiance = light.tubes[0].radiance;
    unused_triangles_.insert(unused_triangles_.end(), light.triangles.begin(), light.triangles.end());
    light.triangles.clear();
    std::visit([&](const auto& s) { set_shape(light, radiance, s); }, shape);
    if (stays_invisible) light.has_new_surface = false;
}

void LightEditor::transform(EditableLight& light, const Transform& transform) {
    const auto move = [&](Float3& p) { p = to_float(transform_point(transform, to_double(p))); };
    for (PolygonLight& polygon : light.polygons)
        for (Float3& p : polygon.vertices) move(p);
    const double scale = std::cbrt(linear_determinant(transform));
    for (LineLight& tube : light.tubes) {
        move(tube.start);
        move(tube.end);
        tube.radius = static_cast<float>(tube.radius * scale);
    }
    for (const std::uint32_t vertex : own_vertices(light)) {
        move(scene_.positions[vertex]);
        Float3& normal = scene_.normals[vertex];
        if (!is_black(normal)) normal = to_float(transform_normal(transform, to_double(normal)));
    }
}

/// Notes of each vertex which light uses it, as far as that is one.
void LightEditor::find_vertex_owners() {
    vertex_owner_.assign(scene_.positions.size(), kNobody);
    for (std::size_t i = 0; i < scene_.triangles.size(); ++i) {
        const std::int32_t light = scene_.triangle_light[i];
        // A vertex that belongs to a surface without light is never a light's own.
        const std::uint32_t user =
            light < 0 ? kShared : scene_.polygon_lights[static_cast<std::size_t>(light)].emitter;
        for (const std::uint32_t vertex : scene_.triangles[i].vertex) {
            std::uint32_t& owner = vertex_owner_[vertex];
            owner = owner == kNobody || owner == user ? user : kShared;
        }
    }
}

/// The vertices of the surface in the scene, each once. Those that other surfaces use too are copied first.
std::vector<std::uint32_t> LightEditor::own_vertices(EditableLight& light) {
    if (light.triangles.empty()) return {};
    if (vertex_owner_.empty()) find_vertex_owners();
    const auto self = static_cast<std::uint32_t>(&light - lights_.data());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> copies; // of which vertex, copy
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
    scene_.polygon_lights.clear();
    scene_.line_lights.clear();
    std::vector<std::int32_t> triangle_light(scene_.triangles.size(), -1);
    for (EditableLight& light : lights_) {
        if (!emits(light)) continue;
        const auto emitter = static_cast<std::uint32_t>(scene_.emitters.size());
        const std::size_t first_polygon = scene_.polygon_lights.size();
        scene_.emitters.push_back({light.name});
        for (PolygonLight& polygon : light.polygons) {
            polygon.emitter = emitter;
            scene_.polygon_lights.push_back(polygon);
        }
        for (LineLight& tube : light.tubes) {
            tube.emitter = emitter;
            scene_.line_lights.push_back(tube);
        }
        for (const std::uint32_t triangle : light.triangles)
            triangle_light[triangle] =
                scene_.triangle_light[triangle] +
                static_cast<std::int32_t>(static_cast<std::int64_t>(first_polygon) - light.first_polygon);
        light.first_polygon = static_cast<std::uint32_t>(first_polygon);
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
    // Lights stand before all objects.
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
        for (const Float3& p : light.polygons[0].vertices) {
            scene_.positions.push_back(p);
            scene_.normals.push_back({0, 0, 0});
            scene_.uvs.push_back({0, 0});
        }
        for (std::uint32_t i = 1; i + 1 < light.polygons[0].vertices.size(); ++i) {
            triangles.push_back({{base, base + i, base + i + 1}});
            materials.push_back(light.material);
            triangle_light.push_back(emits(light) ? static_cast<std::int32_t>(light.first_polygon) : -1);
        }
    }
    check_counts(scene_.positions.size(), scene_.triangles.size() + triangles.size());
    const std::size_t position = world_triangle_count(scene_);
    insert_at(scene_.triangles, position, triangles);
    insert_at(scene_.triangle_material, position, materials);
    insert_at(scene_.triangle_light, position, triangle_light);
    for (Object& object : scene_.objects)
        object.first_triangle += static_cast<std::uint32_t>(triangles.size());
}

} // namespace nusselt::scene
