// Linear lights and tubes, for shaders/passes/lights/line.glsl.

#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/record_values.h"
#include "scene/model/library_vector.h"

#include <nusselt/geometry/line_segment.h>

#include <algorithm>
#include <stdexcept>

namespace nusselt::render_vulkan {

namespace {

using scene::TubeModel;

constexpr bool is_number_of(TubeModel model, std::uint32_t number) {
    return static_cast<std::uint32_t>(model) == number;
}
static_assert(is_number_of(TubeModel::linear, interface::kLinearTube) &&
              is_number_of(TubeModel::solid, interface::kSolidTube) &&
              is_number_of(TubeModel::open, interface::kOpenTube) &&
              is_number_of(TubeModel::strip, interface::kStrip));

} // namespace

bool write_lines(const scene::Scene& /*scene*/, const scene::LightList& list, LightRecords& records) {
    const auto* const lines = dynamic_cast<const scene::LightsOf<scene::LineLight>*>(&list);
    if (lines == nullptr) return false;
    if (std::any_of(lines->lights.begin(), lines->lights.end(),
                    [](const auto& light) { return light.texture >= 0; }))
        throw std::runtime_error("lights that emit an image are not supported on GPUs; use --backend cpu");
    if (std::any_of(lines->lights.begin(), lines->lights.end(),
                    [](const auto& light) { return light.profile >= 0; }))
        throw std::runtime_error(
            "tubes and lines with a profile or a spread are not supported on GPUs; use --backend cpu");
    std::vector<interface::LineLightRecord> lights;
    for (const scene::LineLight& light : lines->lights) {
        const auto line = make_line(to_vec(light.start), to_vec(light.end));
        interface::LineLightRecord& record = lights.emplace_back();
        copy(scene::to_float3(line.p0), record.begin);
        copy(scene::to_float3(line.s), record.direction);
        record.len = line.length;
        record.radius = light.radius;
        record.model = static_cast<std::uint32_t>(light.model);
        const bool is_cylinder = light.model == TubeModel::solid || light.model == TubeModel::open;
        records.has_shape_of(is_cylinder ? interface::kTubesConstant : interface::kLinesConstant) = true;
        copy(light.normal, record.normal);
        copy(light.radiance, record.radiance);
    }
    records.array_at(interface::kLineLightsBinding) = make_light_array("linear lights", lights);
    return true;
}

} // namespace nusselt::render_vulkan
