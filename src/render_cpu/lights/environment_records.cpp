#include "render_cpu/lights/environment_records.h"

#include "scene/model/library_vector.h"
#include "scene/model/scene.h"

#include <nusselt/emission/environment_map.h>

#include <cstddef>
#include <deque>
#include <vector>

namespace nusselt::render_cpu {

namespace {

/// A map with the radiance of its light.
struct PreparedMap {
    PreparedMap(const scene::EnvironmentMapTexels& map, const scene::Float3& radiance)
        : texels(map.texels.size()),
          storage(
              static_cast<std::size_t>(EnvironmentMap<float, kEnvironmentCells>::storage_size(map.size))) {
        const auto ratio = [](float x, float mean) { return mean > 0 ? x / mean : 0; };
        const Vec3<float> scale{ratio(radiance.x, map.mean.x), ratio(radiance.y, map.mean.y),
                                ratio(radiance.z, map.mean.z)};
        for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = scale * scene::to_vec(map.texels[i]);
        light = make_environment_map<kEnvironmentCells>(OctahedralMap<float>{texels.data(), map.size},
                                                        storage.data());
    }

    std::vector<Vec3<float>> texels;
    std::vector<float> storage;
    EnvironmentMap<float, kEnvironmentCells> light{
        {}, PyramidShape(kEnvironmentCells, kEnvironmentCells, kEnvironmentCells), {}, {}, {}, {}, {}, {},
        {}};
};

struct Environments {
    std::vector<EnvironmentRecord> lights;
    std::deque<PreparedMap> maps;
};

} // namespace

std::shared_ptr<const void> make_environment_records(const scene::Scene& scene,
                                                     const scene::LightList& list) {
    const auto* const lights = dynamic_cast<const scene::LightsOf<scene::EnvironmentLight>*>(&list);
    if (lights == nullptr) return nullptr;
    const auto environments = std::make_shared<Environments>();
    for (const scene::EnvironmentLight& light : lights->lights) {
        const void* map = nullptr;
        if (light.map >= 0)
            map = &environments->maps
                       .emplace_back(*scene.environment_maps.at(static_cast<std::size_t>(light.map)),
                                     light.radiance)
                       .light;
        environments->lights.push_back({light.x_axis, light.y_axis, light.z_axis, light.radiance, map});
    }
    return {environments, environments->lights.data()};
}

} // namespace nusselt::render_cpu
