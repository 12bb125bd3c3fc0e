#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/record_values.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

namespace nusselt::render_vulkan {

namespace {

using WriteLights = bool (*)(const scene::Scene& scene, const scene::LightList& list, LightRecords& records);

/// By the number of the kind in shaders/interface/lights.h.
constexpr WriteLights kKinds[] = {write_polygons, write_lines, write_points, write_distants,
                                  write_environments};
static_assert(std::size(kKinds) == interface::kLightKinds);

/// Shaders with cells have room for 8 vertices only: those for environments without a portal and for radiance that varies
/// over polygons or along lines.
int polygon_slots_for(const scene::Scene& scene) {
    const auto& lines = scene.lights.of<scene::LineLight>();
    const auto& polygons = scene.lights.of<scene::PolygonLight>();
    const auto& environments = scene.lights.of<scene::EnvironmentLight>();
    const bool are_small =
        std::all_of(environments.begin(), environments.end(),
                    [](const auto& light) { return light.portal.size() > 0 && light.portal.size() <= 4; }) &&
        std::all_of(polygons.begin(), polygons.end(),
                    [](const auto& light) { return light.vertices.size() <= 4 && light.texture < 0; }) &&
        std::all_of(lines.begin(), lines.end(), [](const auto& line) { return line.texture < 0; });
    return are_small ? 4 : 8;
}

} // namespace

LightRecords make_light_records(const scene::Scene& scene) {
    checked_count(scene.lights.size(), "lights"); // 32 bits then suffice for each list, too
    LightRecords records;
    records.polygon_slots = polygon_slots_for(scene);
    std::uint32_t number = 0;
    for (const scene::LightList& list : scene.lights) {
        const auto count = static_cast<std::uint32_t>(list.size());
        const auto* const kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                              [&](WriteLights write) { return write(scene, list, records); });
        if (kind != std::end(kKinds))
            records.ranges.at(static_cast<std::size_t>(kind - kKinds)) = {number, count};
        else if (count > 0)
            throw std::runtime_error(std::string(list.name()) +
                                     " lights are not supported on GPUs; use --backend cpu");
        number += count;
    }
    return records;
}

} // namespace nusselt::render_vulkan
