#include "visibility/scene_parts.h"

#include "scene/model/lights/round/round_axes.h"
#include "visibility/alpha.h"

#include <algorithm>

namespace nusselt::visibility {

namespace {

bool is_always_there(const scene::Material& material) { return presence_of(material) == Presence::full; }

/// Looks at each triangle.
ScenePart make_part(const scene::Scene& scene, std::uint32_t first_triangle, std::uint32_t triangle_count) {
    ScenePart part{&scene, first_triangle, triangle_count, true};
    const std::uint32_t end = first_triangle + triangle_count;
    const auto presence_in_part = [&](std::uint32_t triangle) {
        return round_light_of(scene, triangle) < 0
                   ? presence_of(scene.materials[scene.triangle_material[triangle]])
                   : Presence::none;
    };
    std::uint32_t full_end = first_triangle;
    while (full_end < end && presence_in_part(full_end) == Presence::full) ++full_end;
    part.is_full = full_end == end;
    if (part.is_full) return part;
    for (std::uint32_t triangle = first_triangle; triangle < end; ++triangle) {
        const Presence presence = presence_in_part(triangle);
        if (presence == Presence::full) part.full.push_back(triangle);
        if (presence == Presence::partial) part.partial.push_back(triangle);
    }
    return part;
}

} // namespace

std::vector<ScenePart> make_parts(const scene::Scene& scene) {
    const bool all_full = scene.lights.of<scene::RoundLight>().empty() &&
                          std::all_of(scene.materials.begin(), scene.materials.end(), is_always_there);
    std::vector<ScenePart> parts;
    const auto add = [&](std::uint32_t first_triangle, std::uint32_t triangle_count) {
        // Most scenes need no look at their triangles.
        parts.push_back(all_full ? ScenePart{&scene, first_triangle, triangle_count, true}
                                 : make_part(scene, first_triangle, triangle_count));
    };
    add(0, static_cast<std::uint32_t>(world_triangle_count(scene)));
    for (const scene::Object& object : scene.objects) add(object.first_triangle, object.triangle_count);
    return parts;
}

} // namespace nusselt::visibility
