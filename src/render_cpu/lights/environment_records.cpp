#include "render_cpu/lights/environment_records.h"

#include "scene/model/library_vector.h"
#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/environment_map.h>

#include <cstddef>
#include <deque>
#include <vector>

namespace nusselt::render_cpu {

namespace {

using Map = EnvironmentMap<float, kEnvironmentCells>;

/// A map with the radiance of its light.
struct PreparedMap {
    PreparedMap(const scene::EnvironmentMapTexels& map, const scene::Float3& radiance)
        : texels(scene::scaled(map.texels, scene::per_channel_ratio(radiance, map.mean))),
          storage(static_cast<std::size_t>(Map::storage_size(map.size))),
          light(make_environment_map<kEnvironmentCells>(OctahedralMap<float>{texels.data(), map.size},
                                                        storage.data())) {}

    std::vector<Vec3<float>> texels;
    std::vector<float> storage;
    Map light;
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
