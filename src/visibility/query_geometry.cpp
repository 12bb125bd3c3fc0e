#include "visibility/query_geometry.h"

#include "scene/model/lights/round/round_axes.h"
#include "visibility/alpha.h"
#include "visibility/embree_builder.h"
#include "visibility/round_surfaces.h"

#include <algorithm>
#include <iterator>

namespace nusselt::visibility {

namespace {

bool has_usable_corners(const scene::Scene& scene, const scene::Triangle& triangle) {
    return std::all_of(std::begin(triangle.vertex), std::end(triangle.vertex), [&](std::uint32_t vertex) {
        const scene::Float3& p = scene.positions[vertex];
        return is_usable({p.x, p.y, p.z});
    });
}

} // namespace

QueryGeometry make_query_geometry(const scene::Scene& scene) {
    QueryGeometry geometry;
    std::vector<std::uint32_t> first_partial;
    const auto add_part = [&](std::size_t first, std::size_t count) {
        QueryPart& part = geometry.parts.emplace_back();
        first_partial.push_back(static_cast<std::uint32_t>(geometry.partial_triangles.size()));
        for (std::size_t i = first; i < first + count; ++i) {
            const scene::Triangle& triangle = scene.triangles[i];
            const Presence presence = presence_of(scene.materials[scene.triangle_material[i]]);
            if (presence == Presence::none || round_light_of(scene, i) >= 0 ||
                !has_usable_corners(scene, triangle))
                continue;
            auto& vertices = presence == Presence::full ? part.opaque : part.partial;
            vertices.insert(vertices.end(), std::begin(triangle.vertex), std::end(triangle.vertex));
            if (presence == Presence::partial)
                geometry.partial_triangles.push_back(static_cast<std::uint32_t>(i));
        }
    };
    add_part(0, world_triangle_count(scene));
    for (const scene::Object& object : scene.objects) add_part(object.first_triangle, object.triangle_count);
    const auto add_instance = [&](std::uint32_t part) {
        geometry.instances.push_back({part, first_partial[part]});
    };
    add_instance(0);
    for (const scene::Instance& instance : scene.instances) add_instance(instance.object + 1);
    // Vulkan would leave out boxes without numbers, but Mesa's software driver then loses the others.
    geometry.round_boxes.resize(scene.lights.of<scene::RoundLight>().size());
    for (const RoundSurface& surface : make_round_surfaces(scene)) {
        auto& box = geometry.round_boxes[surface.round_light];
        std::copy(surface.lower.begin(), surface.lower.end(), box.begin());
        std::copy(surface.upper.begin(), surface.upper.end(), box.begin() + 3);
    }
    return geometry;
}

} // namespace nusselt::visibility
