#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/record_values.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

namespace nusselt::render_vulkan {

namespace {

template <class Light>
bool is_list_of(const scene::LightList& list) {
    return dynamic_cast<const scene::LightsOf<Light>*>(&list) != nullptr;
}

/// A kind of light that shaders know.
struct Kind {
    bool (*has)(const scene::LightList& list);
    void (*write)(const scene::Scene& scene, const scene::LightList& list, LightRecords& records);
};

/// By the number of the kind in shaders/interface/lights.h.
constexpr Kind kKinds[] = {{is_list_of<scene::PolygonLight>, write_polygons},
                           {is_list_of<scene::LineLight>, write_lines},
                           {is_list_of<scene::PointLight>, write_points},
                           {is_list_of<scene::DistantLight>, write_distants},
                           {is_list_of<scene::EnvironmentLight>, write_environments},
                           {is_list_of<scene::RoundLight>, write_rounds}};
static_assert(std::size(kKinds) == interface::kLightKinds);

/// The end of the table if shaders do not know the kind.
const Kind* find_kind(const scene::LightList& list) {
    return std::find_if(std::begin(kKinds), std::end(kKinds),
                        [&](const Kind& kind) { return kind.has(list); });
}

/// Shaders with cells and those for round lights have room for 8 vertices only. Cells are for environments without a portal and
/// for radiance that varies over polygons or along lines.
int polygon_slots_for(const scene::Scene& scene) {
    const auto& lines = scene.lights.of<scene::LineLight>();
    const auto& polygons = scene.lights.of<scene::PolygonLight>();
    const auto& environments = scene.lights.of<scene::EnvironmentLight>();
    const bool are_small =
        scene.lights.of<scene::RoundLight>().empty() &&
        std::all_of(environments.begin(), environments.end(),
                    [](const auto& light) { return light.portal.size() > 0 && light.portal.size() <= 4; }) &&
        std::all_of(polygons.begin(), polygons.end(),
                    [](const auto& light) { return light.vertices.size() <= 4 && light.texture < 0; }) &&
        std::all_of(lines.begin(), lines.end(), [](const auto& line) { return line.texture < 0; });
    return are_small ? 4 : 8;
}

} // namespace

std::optional<std::string> why_unsupported(const scene::Lights& lights) {
    for (const scene::LightList& list : lights)
        if (list.size() > 0 && find_kind(list) == std::end(kKinds))
            return std::string(list.name()) + " lights are not supported on GPUs";
    return std::nullopt;
}

LightRecords make_light_records(const scene::Scene& scene) {
    if (const auto reason = why_unsupported(scene.lights))
        throw std::runtime_error(*reason + "; use --backend cpu");
    checked_count(scene.lights.size(), "lights"); // 32 bits then suffice for each list, too
    LightRecords records;
    records.polygon_slots = polygon_slots_for(scene);
    std::uint32_t number = 0;
    for (const scene::LightList& list : scene.lights) {
        const auto count = static_cast<std::uint32_t>(list.size());
        const Kind* const kind = find_kind(list);
        if (kind == std::end(kKinds)) continue; // without lights
        kind->write(scene, list, records);
        records.ranges.at(static_cast<std::size_t>(kind - kKinds)) = {number, count};
        number += count;
    }
    return records;
}

} // namespace nusselt::render_vulkan
