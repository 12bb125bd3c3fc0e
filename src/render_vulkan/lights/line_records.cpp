// Linear lights and tubes, for shaders/passes/lights/line.glsl.

#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/record_values.h"
#include "scene/model/library_vector.h"

#include <nusselt/geometry/line_segment.h>

namespace nusselt::render_vulkan {

bool write_lines(const scene::LightList& list, LightRecords& records) {
    const auto* const lines = dynamic_cast<const scene::LightsOf<scene::LineLight>*>(&list);
    if (lines == nullptr) return false;
    std::vector<interface::LineLightRecord> lights;
    for (const scene::LineLight& light : lines->lights) {
        const auto line = make_line(to_vec(light.start), to_vec(light.end));
        interface::LineLightRecord& record = lights.emplace_back();
        copy(scene::to_float3(line.p0), record.begin);
        copy(scene::to_float3(line.s), record.direction);
        record.len = line.length;
        record.radius = light.radius;
        const bool is_solid = light.model == scene::TubeModel::solid;
        record.is_solid = is_solid ? 1 : 0;
        records.has_shape_of(is_solid ? interface::kTubesConstant : interface::kLinesConstant) = true;
        copy(light.radiance, record.radiance);
    }
    records.array_at(interface::kLineLightsBinding) = make_light_array("linear lights", lights);
    return true;
}

} // namespace nusselt::render_vulkan
