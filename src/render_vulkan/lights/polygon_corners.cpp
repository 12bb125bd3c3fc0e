#include "render_vulkan/lights/polygon_corners.h"

#include "render_vulkan/record_values.h"
#include "scene/model/library_vector.h"

#include <nusselt/geometry/convex_polygon.h>

#include <bit>
#include <cstddef>
#include <vector>

namespace nusselt::render_vulkan {

namespace {

template <int N>
scene::Float3 add_with_room(const scene::PolygonVertices& vertices, std::vector<std::uint32_t>& words) {
    Vec3<float> corners[N] = {};
    for (std::size_t j = 0; j < vertices.size(); ++j) corners[j] = to_vec(vertices[j]);
    const auto polygon = make_polygon<N>(corners, static_cast<int>(vertices.size()));
    const auto add = [&](const Vec3<float>& v) {
        for (const float component : {v.x, v.y, v.z})
            words.push_back(std::bit_cast<std::uint32_t>(component));
    };
    for (const Vec3<float>& vertex : polygon.vertex) add(vertex);
    for (const Vec3<float>& edge : polygon.edge) add(edge);
    return scene::to_float3(polygon.normal);
}

} // namespace

StoredPolygon add_corners(const scene::PolygonVertices& vertices, LightRecords& records) {
    LightArray& corners = records.array_at(interface::kPolygonCornersBinding);
    corners.what = "corners of lights";
    const std::size_t slots = static_cast<std::size_t>(records.polygon_slots);
    checked_count(corners.words.size() + 6 * slots, "coordinates of lights");
    const auto first = static_cast<std::uint32_t>(corners.words.size());
    const scene::Float3 normal =
        slots == 4 ? add_with_room<4>(vertices, corners.words) : add_with_room<8>(vertices, corners.words);
    return {first, normal};
}

} // namespace nusselt::render_vulkan
