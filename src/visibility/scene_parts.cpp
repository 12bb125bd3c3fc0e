#include "visibility/scene_parts.h"

#include "visibility/alpha.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace nusselt::visibility {

namespace {

bool is_always_there(const scene::Material& material) { return presence_of(material) == Presence::full; }

/// Looks at each triangle.
ScenePart make_part(const scene::Scene& scene, std::uint32_t first_triangle, std::uint32_t triangle_count) {
    ScenePart part{&scene, first_triangle, triangle_count, true};
    const std::uint32_t end = first_triangle + triangle_count;
    const auto is_full = [&](std::uint32_t material) { return is_always_there(scene.materials[material]); };
    const auto materials = scene.triangle_material.begin();
    part.is_full = std::all_of(materials + first_triangle, materials + end, is_full);
    if (part.is_full) return part;
    for (std::uint32_t triangle = first_triangle; triangle < end; ++triangle) {
        const Presence presence = presence_of(scene.materials[scene.triangle_material[triangle]]);
        if (presence == Presence::full) part.full.push_back(triangle);
        if (presence == Presence::partial) part.partial.push_back(triangle);
    }
    return part;
}

} // namespace

void separate_seen(ScenePart& part, const std::vector<std::uint32_t>& triangles) {
    if (triangles.empty()) return;
    std::vector<std::uint32_t> all = std::move(part.full);
    if (part.is_full) {
        all.resize(part.triangle_count);
        std::iota(all.begin(), all.end(), part.first_triangle);
    }
    part.full.clear();
    std::set_difference(all.begin(), all.end(), triangles.begin(), triangles.end(),
                        std::back_inserter(part.full));
    part.is_full = false;
    part.seen = triangles;
}

std::vector<ScenePart> make_parts(const scene::Scene& scene) {
    const bool all_full = std::all_of(scene.materials.begin(), scene.materials.end(), is_always_there);
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
