// Environments, for shaders/passes/lights/environment.glsl.

#include "render_vulkan/lights/emission_words.h"
#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/lights/polygon_corners.h"
#include "render_vulkan/record_values.h"
#include "scene/model/library_vector.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/environment_map_words.h>

#include <cstddef>
#include <map>
#include <tuple>

namespace nusselt::render_vulkan {

namespace {

static_assert(ShaderEnvironment::kCells == kShaderCells * kShaderCells);

/// Appends the texels of a map, then its words.
/// \returns the number of the first one after the texels
std::uint32_t add_map(const scene::EnvironmentMapTexels& map, const scene::Float3& radiance,
                      std::vector<std::uint32_t>& words) {
    const std::vector<Vec3<float>> texels =
        scene::scaled(map.texels, scene::per_channel_ratio(radiance, map.mean));
    std::vector<float> storage(static_cast<std::size_t>(ShaderEnvironment::storage_size(map.size)));
    const ShaderEnvironment light =
        make_environment_map<kShaderCells>(OctahedralMap<float>{texels.data(), map.size}, storage.data());
    add_texels(texels, words);
    const std::uint32_t first =
        grow_words(words, static_cast<std::size_t>(EnvironmentMapWords::count(light)));
    EnvironmentMapWords::write(light, words.data() + first);
    return first;
}

/// Appends the portal of a light, if it has one.
StoredPolygon add_portal(const scene::EnvironmentLight& light, LightRecords& records) {
    if (light.portal.size() == 0) return {interface::kNoWords, {0, 0, 0}};
    return add_corners(light.portal, records);
}

} // namespace

int constant_of(const scene::EnvironmentLight& light) {
    if (light.portal.size() > 0)
        return light.map < 0 ? interface::kUniformPortalsConstant : interface::kMappedPortalsConstant;
    return light.map < 0 ? interface::kUniformEnvironmentsConstant : interface::kMappedEnvironmentsConstant;
}

void write_environments(const scene::Scene& scene, const scene::LightList& list, LightRecords& records) {
    const auto& environments = dynamic_cast<const scene::LightsOf<scene::EnvironmentLight>&>(list);
    std::vector<std::uint32_t>& words = records.array_at(interface::kEmissionWordsBinding).words;
    std::vector<interface::EnvironmentLightRecord> lights;
    // Lights with the same map and radiance share its words.
    std::map<std::tuple<const scene::EnvironmentMapTexels*, float, float, float>, std::uint32_t> maps;
    for (const scene::EnvironmentLight& light : environments.lights) {
        interface::EnvironmentLightRecord& record = lights.emplace_back();
        copy(light.x_axis, record.x_axis);
        copy(light.y_axis, record.y_axis);
        copy(light.z_axis, record.z_axis);
        copy(light.radiance, record.radiance);
        record.first_map_word = interface::kNoWords;
        const StoredPolygon portal = add_portal(light, records);
        copy(portal.normal, record.normal);
        record.first_corner_word = portal.first_word;
        records.has_shape_of(constant_of(light)) = true;
        if (light.map < 0) continue;
        const scene::EnvironmentMapTexels& map =
            *scene.environment_maps.at(static_cast<std::size_t>(light.map));
        const auto [known, is_new] =
            maps.try_emplace({&map, light.radiance.x, light.radiance.y, light.radiance.z});
        if (is_new) known->second = add_map(map, light.radiance, words);
        record.first_map_word = known->second;
    }
    records.array_at(interface::kEnvironmentLightsBinding) = make_light_array("environments", lights);
}

} // namespace nusselt::render_vulkan
