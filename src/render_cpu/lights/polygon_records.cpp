#include "render_cpu/lights/polygon_records.h"

#include "render_cpu/lights/float_count.h"
#include "render_cpu/lights/polygon_corners.h"
#include "render_cpu/lights/polygon_profiles.h"
#include "render_cpu/lights/polygon_textures.h"
#include "scene/model/scene.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::render_cpu {

namespace {

struct PolygonArrays {
    std::vector<PolygonRecord> lights;
    std::vector<scene::Float3> corners;
    PolygonTextures textures;
    PolygonProfiles profiles;
    PolygonRecords view{};
};

PolygonRecord make_record(const scene::Scene& scene, const scene::PolygonLight& light,
                          std::vector<scene::Float3>& all_corners) {
    const std::size_t count = light.vertices.size();
    if (count < 3)
        throw std::runtime_error("light " + scene.emitters[light.emitter].name +
                                 ": polygonal lights must have at least 3 vertices, found " +
                                 std::to_string(count));
    PolygonRecord record{};
    const PolygonCorners corners(light.vertices);
    record.slots = corners.slots;
    record.first_corner = static_cast<std::uint32_t>(all_corners.size());
    all_corners.insert(all_corners.end(), corners.corners.begin(), corners.corners.end());
    record.normal = corners.normal;
    record.radiance = light.radiance;
    record.two_sided = light.two_sided ? 1 : 0;
    record.texture = -1;
    record.profile = -1;
    return record;
}

} // namespace

std::shared_ptr<const void> make_polygon_records(const scene::Scene& scene, const scene::LightList& list) {
    const auto* const polygons = dynamic_cast<const scene::LightsOf<scene::PolygonLight>*>(&list);
    if (polygons == nullptr) return nullptr;
    std::size_t corners = 0;
    for (const scene::PolygonLight& light : polygons->lights)
        corners += 2 * static_cast<std::size_t>(slots_of(light.vertices));
    check_float_count(3 * corners, "lights");
    const auto arrays = std::make_shared<PolygonArrays>();
    arrays->corners.reserve(corners);
    arrays->lights.reserve(polygons->lights.size());
    for (const scene::PolygonLight& light : polygons->lights) {
        arrays->lights.push_back(make_record(scene, light, arrays->corners));
        if (light.texture >= 0) arrays->lights.back().texture = arrays->textures.add(scene, light);
        if (light.profile >= 0) arrays->lights.back().profile = arrays->profiles.add(scene, light);
    }
    arrays->view = {arrays->lights.data(), arrays->corners.data(), arrays->textures.records(),
                    arrays->profiles.records()};
    return {arrays, &arrays->view};
}

} // namespace nusselt::render_cpu
