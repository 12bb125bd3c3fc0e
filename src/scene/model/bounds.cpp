#include "scene/model/bounds.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace nusselt::scene {

namespace {

constexpr double kMax = std::numeric_limits<double>::max();

Double3 transformed_point(const std::array<float, 12>& rows, const Double3& p) {
    const auto row = [&](std::size_t i) {
        return rows[i] * p.x + rows[i + 1] * p.y + rows[i + 2] * p.z + static_cast<double>(rows[i + 3]);
    };
    return {row(0), row(4), row(8)};
}

} // namespace

Bounds::Bounds() : low{kMax, kMax, kMax}, high{-kMax, -kMax, -kMax} {}

void Bounds::add(const Double3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

void Bounds::add(const Bounds& other) {
    if (other.is_empty()) return;
    add(other.low);
    add(other.high);
}

Bounds triangle_bounds(const Scene& scene, std::size_t first, std::size_t count) {
    Bounds bounds;
    for (std::size_t i = first; i < first + count; ++i)
        for (const std::uint32_t vertex : scene.triangles[i].vertex)
            bounds.add(to_double(scene.positions[vertex]));
    return bounds;
}

Bounds transformed(const Bounds& box, const std::array<float, 12>& rows) {
    Bounds result;
    if (box.is_empty()) return result;
    for (const double x : {box.low.x, box.high.x})
        for (const double y : {box.low.y, box.high.y})
            for (const double z : {box.low.z, box.high.z}) result.add(transformed_point(rows, {x, y, z}));
    return result;
}

Bounds scene_bounds(const Scene& scene) {
    Bounds bounds = triangle_bounds(scene, 0, world_triangle_count(scene));
    std::vector<Bounds> objects;
    for (const Object& object : scene.objects)
        objects.push_back(triangle_bounds(scene, object.first_triangle, object.triangle_count));
    for (const Instance& instance : scene.instances)
        bounds.add(transformed(objects[instance.object], instance.world_from_object));
    for (const LightList& list : scene.lights) list.add_to(bounds);
    return bounds;
}

double scene_radius(const Scene& scene) {
    const Bounds bounds = scene_bounds(scene);
    return bounds.is_empty() ? 0 : 0.5 * length(bounds.high - bounds.low);
}

} // namespace nusselt::scene
