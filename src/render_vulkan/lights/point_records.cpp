// Point lights, for shaders/passes/lights/point.glsl.

#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/lights/luminaire_words.h"
#include "render_vulkan/record_values.h"
#include "scene/model/profiles/luminaire.h"

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
              is_number_of(PointDistribution::projected_image, interface::kProjectedImage) &&
              is_number_of(PointDistribution::profile, interface::kProfile));

/// Appends the luminaire of a light, if it has one. \returns its first word
std::uint32_t add_luminaire(const scene::Scene& scene, const scene::PointLight& light,
                            LuminaireWords& luminaires, std::vector<std::uint32_t>& words) {
    if (light.distribution != PointDistribution::profile) return interface::kNoWords;
    const auto& measured = scene.luminaires.at(static_cast<std::size_t>(light.profile));
    return luminaires.add(measured, measured->profile.peak().candelas, words);
}

} // namespace

int constant_of(const scene::PointLight& light) {
    if (light.distribution == PointDistribution::profile) return interface::kPointProfilesConstant;
    return is_image(light.distribution) ? interface::kPointImagesConstant : interface::kPointsConstant;
}

void write_points(const scene::Scene& scene, const scene::LightList& list, LightRecords& records) {
    const auto& points = dynamic_cast<const scene::LightsOf<scene::PointLight>&>(list);
    std::vector<interface::PointLightRecord> lights;
    LuminaireWords luminaires;
    for (const scene::PointLight& light : points.lights) {
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
        record.first_luminaire_word =
            add_luminaire(scene, light, luminaires, records.array_at(interface::kEmissionWordsBinding).words);
        records.has_shape_of(constant_of(light)) = true;
    }
    records.array_at(interface::kPointLightsBinding) = make_light_array("point lights", lights);
}

} // namespace nusselt::render_vulkan
