// Point lights, for shaders/passes/lights/point.glsl.

#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/record_values.h"

#include <stdexcept>

namespace nusselt::render_vulkan {

namespace {

using scene::PointDistribution;

constexpr bool is_number_of(PointDistribution distribution, std::uint32_t number) {
    return static_cast<std::uint32_t>(distribution) == number;
}
static_assert(is_number_of(PointDistribution::isotropic, interface::kIsotropic) &&
              is_number_of(PointDistribution::smooth_cone, interface::kSmoothCone) &&
              is_number_of(PointDistribution::quartic_cone, interface::kQuarticCone) &&
              is_number_of(PointDistribution::octahedral_image, interface::kOctahedralImage) &&
              is_number_of(PointDistribution::latitude_image, interface::kLatitudeImage) &&
              is_number_of(PointDistribution::projected_image, interface::kProjectedImage));

} // namespace

bool write_points(const scene::Scene& /*scene*/, const scene::LightList& list, LightRecords& records) {
    const auto* const points = dynamic_cast<const scene::LightsOf<scene::PointLight>*>(&list);
    if (points == nullptr) return false;
    std::vector<interface::PointLightRecord> lights;
    for (const scene::PointLight& light : points->lights) {
        if (light.distribution == PointDistribution::profile)
            throw std::runtime_error("lights with a profile are not supported on GPUs; use --backend cpu");
        const scene::ConeFalloff falloff = cone_falloff(light);
        interface::PointLightRecord& record = lights.emplace_back();
        copy(light.position, record.position);
        copy(light.x_axis, record.x_axis);
        copy(light.y_axis, record.y_axis);
        copy(light.z_axis, record.z_axis);
        copy(light.intensity, record.intensity);
        record.distribution = static_cast<std::uint32_t>(light.distribution);
        record.cone_end = static_cast<float>(falloff.end);
        record.inverse_cone_width = scene::inverse_width(falloff);
        record.half_extent[0] = light.half_extent.x;
        record.half_extent[1] = light.half_extent.y;
        record.texture_number = light.texture;
        records.has_shape_of(is_image(light.distribution) ? interface::kPointImagesConstant
                                                          : interface::kPointsConstant) = true;
    }
    records.array_at(interface::kPointLightsBinding) = make_light_array("point lights", lights);
    return true;
}

} // namespace nusselt::render_vulkan
