// Polygonal lights, for shaders/passes/lights/polygon.glsl.

#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/lights/polygon_corners.h"
#include "render_vulkan/lights/polygon_textures.h"
#include "render_vulkan/lights/profile_words.h"
#include "render_vulkan/record_values.h"

namespace nusselt::render_vulkan {

namespace {

struct PolygonArrays {
    std::vector<interface::PolygonLightRecord> lights;
    std::vector<interface::PolygonTextureRecord> textures;
};

interface::PolygonLightRecord make_record(const scene::PolygonLight& light, LightRecords& records) {
    const StoredPolygon polygon = add_corners(light.vertices, records);
    interface::PolygonLightRecord record {};
    copy(polygon.normal, record.normal);
    copy(light.radiance, record.radiance);
    record.is_two_sided = light.two_sided ? 1 : 0;
    record.first_corner_word = polygon.first_word;
    record.texture_number = -1;
    record.first_profile_word = interface::kNoWords;
    return record;
}

} // namespace

int constant_of(const scene::PolygonLight& light) {
    if (light.profile >= 0) return interface::kProfiledPolygonsConstant;
    return light.texture < 0 ? interface::kPolygonsConstant : interface::kTexturedPolygonsConstant;
}

void write_polygons(const scene::Scene& scene, const scene::LightList& list, LightRecords& records) {
    const std::vector<scene::PolygonLight>& lights =
        dynamic_cast<const scene::LightsOf<scene::PolygonLight>&>(list).lights;
    PolygonArrays arrays;
    LightArray& emission = records.array_at(interface::kEmissionWordsBinding);
    emission.what = "emission that varies";
    ProfileWords profiles(emission.words);
    PolygonTextures textures(records.polygon_slots, emission.words);
    for (const scene::PolygonLight& light : lights) {
        interface::PolygonLightRecord& record = arrays.lights.emplace_back(make_record(light, records));
        records.has_shape_of(constant_of(light)) = true;
        if (light.profile >= 0) record.first_profile_word = profiles.add(scene, light);
        if (light.texture < 0) continue;
        record.texture_number = static_cast<std::int32_t>(arrays.textures.size());
        arrays.textures.push_back(textures.add(scene, light));
    }
    records.array_at(interface::kPolygonLightsBinding) = make_light_array("polygonal lights", arrays.lights);
    records.array_at(interface::kPolygonTexturesBinding) =
        make_light_array("textures of lights", arrays.textures);
}

} // namespace nusselt::render_vulkan
