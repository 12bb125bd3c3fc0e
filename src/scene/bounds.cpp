#include "scene/bounds.h"

#include <algorithm>
#include <vector>

namespace nusselt::scene {

namespace {

Double3 transformed(const std::array<float, 12>& rows, const Double3& p) {
    const auto row = [&](std::size_t i) {
        return dot({rows[i], rows[i + 1], rows[i + 2]}, p) + static_cast<double>(rows[i + 3]);
    };
    return {row(0), row(4), row(8)};
}

/// Adds the image of a box.
void add_box(const Bounds& box, const std::array<float, 12>& rows, Bounds& bounds) {
    for (const double x : {box.low.x, box.high.x})
        for (const double y : {box.low.y, box.high.y})
            for (const double z : {box.low.z, box.high.z}) bounds.add(transformed(rows, {x, y, z}));
}

} // namespace

void Bounds::add(const Double3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

double scene_radius(const Scene& scene) {
    std::vector<char> is_of_object(scene.positions.size(), 0);
    std::vector<Bounds> boxes;
    for (const Object& object : scene.objects) {
        Bounds& box = boxes.emplace_back();
        for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
            for (const std::uint32_t vertex : scene.triangles[object.first_triangle + i].vertex) {
                is_of_object[vertex] = 1;
                box.add(to_double(scene.positions[vertex]));
            }
        }
    }
    Bounds bounds;
    for (const Instance& instance : scene.instances)
        add_box(boxes[instance.object], instance.world_from_object, bounds);
    for (std::size_t i = 0; i < scene.positions.size(); ++i)
        if (is_of_object[i] == 0) bounds.add(to_double(scene.positions[i]));
    for (const LineLight& line : scene.line_lights) {
        const Double3 margin = {line.radius, line.radius, line.radius};
        for (const Float3& end : {line.begin, line.end}) {
            bounds.add(to_double(end) - margin);
            bounds.add(to_double(end) + margin);
        }
    }
    return bounds.low.x <= bounds.high.x ? 0.5 * length(bounds.high - bounds.low) : 0;
}

} // namespace nusselt::scene
