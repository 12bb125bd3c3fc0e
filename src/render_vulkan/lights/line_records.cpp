// Linear lights and tubes, for shaders/passes/lights/line.glsl.

#include "render_vulkan/lights/emission_words.h"
#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/lights/profile_words.h"
#include "render_vulkan/record_values.h"
#include "scene/model/library_vector.h"
#include "scene/model/lights/line_radiance.h"
#include "scene/model/vector_math.h"

#include <nusselt/geometry/line_segment.h>
#include <nusselt/line_emission/line_profile_words.h>

#include <cstddef>
#include <vector>

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

/// Appends the radiance along a light. \returns the number of the first word
std::uint32_t add_profile(const scene::Scene& scene, const scene::LineLight& light,
                          std::vector<std::uint32_t>& words) {
    const auto& emission = scene.emission_textures.at(static_cast<std::size_t>(light.texture));
    const ShaderLineProfile profile = radiance_along(light, emission);
    const std::uint32_t first = grow_words(words, static_cast<std::size_t>(LineProfileWords::count(profile)));
    LineProfileWords::write(profile, words.data() + first);
    return first;
}

} // namespace

int constant_of(const scene::LineLight& light) {
    const bool is_tube = light.model == TubeModel::solid || light.model == TubeModel::open;
    if (light.profile >= 0)
        return is_tube ? interface::kProfiledTubesConstant : interface::kProfiledLinesConstant;
    if (light.texture >= 0)
        return is_tube ? interface::kTexturedTubesConstant : interface::kTexturedLinesConstant;
    return is_tube ? interface::kTubesConstant : interface::kLinesConstant;
}

void write_lines(const scene::Scene& scene, const scene::LightList& list, LightRecords& records) {
    const auto& lines = dynamic_cast<const scene::LightsOf<scene::LineLight>&>(list);
    std::vector<std::uint32_t>& words = records.array_at(interface::kEmissionWordsBinding).words;
    ProfileWords directions(words);
    std::vector<interface::LineLightRecord> lights;
    for (const scene::LineLight& light : lines.lights) {
        const auto line = make_line(to_vec(light.start), to_vec(light.end));
        interface::LineLightRecord& record = lights.emplace_back();
        copy(scene::to_float3(line.p0), record.begin);
        copy(scene::to_float3(line.s), record.direction);
        record.len = line.length;
        record.radius = light.radius;
        record.model = static_cast<std::uint32_t>(light.model);
        copy(light.normal, record.normal);
        copy(light.radiance, record.radiance);
        copy(scene::per_channel_ratio({1, 1, 1}, light.radiance), record.inverse_mean);
        records.has_shape_of(constant_of(light)) = true;
        record.first_texture_word =
            light.texture < 0 ? interface::kNoWords : add_profile(scene, light, words);
        record.first_profile_word = light.profile < 0 ? interface::kNoWords : directions.add(scene, light);
    }
    records.array_at(interface::kLineLightsBinding) = make_light_array("linear lights", lights);
}

} // namespace nusselt::render_vulkan
