// Polygonal lights, for shaders/passes/lights/polygon.glsl.

#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/lights/polygon_profiles.h"
#include "render_vulkan/lights/polygon_textures.h"
#include "render_vulkan/record_values.h"
#include "scene/model/library_vector.h"

#include <nusselt/geometry/convex_polygon.h>

namespace nusselt::render_vulkan {

namespace {

struct PolygonArrays {
    std::vector<interface::PolygonLightRecord> lights;
    std::vector<scene::Float3> corners; ///< of each light the vertices, then the edges
    std::vector<interface::PolygonTextureRecord> textures;
};

template <int N>
void add_polygon(const scene::PolygonLight& light, PolygonArrays& arrays) {
    Vec3<float> corners[N] = {};
    for (std::size_t j = 0; j < light.vertices.size(); ++j) corners[j] = to_vec(light.vertices[j]);
    const auto polygon = make_polygon<N>(corners, static_cast<int>(light.vertices.size()));
    for (const Vec3<float>& vertex : polygon.vertex) arrays.corners.push_back(scene::to_float3(vertex));
    for (const Vec3<float>& edge : polygon.edge) arrays.corners.push_back(scene::to_float3(edge));
    interface::PolygonLightRecord& record = arrays.lights.emplace_back();
    copy(scene::to_float3(polygon.normal), record.normal);
    copy(light.radiance, record.radiance);
    record.is_two_sided = light.two_sided ? 1 : 0;
    record.texture_number = -1;
    record.first_profile_word = interface::kNoWords;
}

/// The constant of the shape that a light is.
int constant_of(const scene::PolygonLight& light) {
    if (light.profile >= 0) return interface::kProfiledPolygonsConstant;
    return light.texture < 0 ? interface::kPolygonsConstant : interface::kTexturedPolygonsConstant;
}

} // namespace

void write_polygons(const scene::Scene& scene, const scene::LightList& list, LightRecords& records) {
    const auto& polygons = dynamic_cast<const scene::LightsOf<scene::PolygonLight>&>(list);
    const std::vector<scene::PolygonLight>& lights = polygons.lights;
    const bool are_small = records.polygon_slots == 4;
    checked_count(6 * lights.size() * 8, "coordinates of lights");
    PolygonArrays arrays;
    LightArray& emission = records.array_at(interface::kEmissionWordsBinding);
    emission.what = "emission that varies";
    PolygonProfiles profiles(emission.words);
    for (const scene::PolygonLight& light : lights) {
        if (are_small)
            add_polygon<4>(light, arrays);
        else
            add_polygon<8>(light, arrays);
        records.has_shape_of(constant_of(light)) = true;
        interface::PolygonLightRecord& record = arrays.lights.back();
        if (light.profile >= 0) record.first_profile_word = profiles.add(scene, light);
        if (light.texture < 0) continue;
        record.texture_number = static_cast<std::int32_t>(arrays.textures.size());
        arrays.textures.push_back(add_texture(scene, light, records.polygon_slots, emission.words));
    }
    records.array_at(interface::kPolygonLightsBinding) = make_light_array("polygonal lights", arrays.lights);
    records.array_at(interface::kPolygonCornersBinding) =
        make_light_array("corners of lights", arrays.corners);
    records.array_at(interface::kPolygonTexturesBinding) =
        make_light_array("textures of lights", arrays.textures);
}

} // namespace nusselt::render_vulkan
