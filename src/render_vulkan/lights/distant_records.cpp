// Distant lights, for shaders/passes/lights/distant.glsl.

#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/record_values.h"

namespace nusselt::render_vulkan {

void write_distants(const scene::Scene& /*scene*/, const scene::LightList& list, LightRecords& records) {
    const auto& distants = dynamic_cast<const scene::LightsOf<scene::DistantLight>&>(list);
    std::vector<interface::DistantLightRecord> lights;
    for (const scene::DistantLight& light : distants.lights) {
        const scene::Float3& way = light.direction;
        interface::DistantLightRecord& record = lights.emplace_back();
        copy({-way.x, -way.y, -way.z}, record.to_light);
        copy(light.irradiance, record.irradiance);
    }
    records.array_at(interface::kDistantLightsBinding) = make_light_array("distant lights", lights);
    records.has_shape_of(interface::kDistantsConstant) = !lights.empty();
}

} // namespace nusselt::render_vulkan
