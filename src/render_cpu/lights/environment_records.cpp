#include "render_cpu/lights/environment_records.h"

#include "scene/model/library_vector.h"
#include "scene/model/scene.h"

#include <nusselt/emission/environment_map.h>
#include <nusselt/emission/windowed_light.h>

#include <algorithm>
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

/// A portal for points on one side of it.
struct PreparedPortal {
    /// \param radiance of a direction in world space
    template <class Radiance>
    PreparedPortal(const std::vector<Vec3<float>>& vertices, const Frame<float>& frame, int texels,
                   const Radiance& radiance)
        : sums(static_cast<std::size_t>(RectifiedTable<float>::size(texels, texels))), colour(sums.size()) {
        constexpr int kLookups = 2;
        const auto in_frame = [&](const Vec3<float>& direction) {
            return radiance(frame.to_world(direction));
        };
        const auto table = make_rectified_table<float>(in_frame, RectifiedDomain<float>::hemisphere(), texels,
                                                       texels, kLookups, sums.data(), colour.data());
        light = make_portal(frame, vertices.data(), static_cast<int>(vertices.size()), table);
    }

    std::vector<RectifiedSums> sums;
    std::vector<Vec3<float>> colour;
    WindowedLight<float> light{};
};

struct Environments {
    std::vector<EnvironmentRecord> lights;
    std::deque<PreparedMap> maps;
    std::deque<PreparedPortal> portals;
};

/// The frame of a portal, with its first axis along the longest side.
Frame<float> frame_of(const std::vector<Vec3<float>>& vertices) {
    Vec3<float> longest{0, 0, 0};
    Vec3<float> normal{0, 0, 0};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3<float> side = vertices[(i + 1) % vertices.size()] - vertices[i];
        if (dot(side, side) > dot(longest, longest)) longest = side;
        if (i >= 2) normal += cross(vertices[i - 1] - vertices[0], vertices[i] - vertices[0]);
    }
    const Vec3<float> n = normalize(normal);
    const Vec3<float> t = normalize(longest - dot(n, longest) * n);
    return {t, cross(n, t), n};
}

void add_portal(const scene::EnvironmentLight& light, const PreparedMap* map, Environments& environments,
                EnvironmentRecord& record) {
    std::vector<Vec3<float>> vertices;
    for (const scene::Float3& vertex : light.portal) vertices.push_back(scene::to_vec(vertex));
    const Frame<float> frame = frame_of(vertices);
    const auto radiance = [&](const Vec3<float>& w) {
        if (map == nullptr) return scene::to_vec(light.radiance);
        return map->light.radiance.lookup(Vec3<float>{dot(scene::to_vec(light.x_axis), w),
                                                      dot(scene::to_vec(light.y_axis), w),
                                                      dot(scene::to_vec(light.z_axis), w)});
    };
    const int texels = map == nullptr ? 16 : std::clamp(map->light.radiance.size, 64, 1024);
    record.portal[0] = &environments.portals.emplace_back(vertices, frame, texels, radiance).light;
    const Frame<float> back{frame.t, -frame.b, -frame.n};
    record.portal[1] = &environments.portals.emplace_back(vertices, back, texels, radiance).light;
}

} // namespace

std::shared_ptr<const void> make_environment_records(const scene::Scene& scene,
                                                     const scene::LightList& list) {
    const auto* const lights = dynamic_cast<const scene::LightsOf<scene::EnvironmentLight>*>(&list);
    if (lights == nullptr) return nullptr;
    const auto environments = std::make_shared<Environments>();
    for (const scene::EnvironmentLight& light : lights->lights) {
        const PreparedMap* map = nullptr;
        if (light.map >= 0)
            map = &environments->maps.emplace_back(
                *scene.environment_maps.at(static_cast<std::size_t>(light.map)), light.radiance);
        environments->lights.push_back({light.x_axis,
                                        light.y_axis,
                                        light.z_axis,
                                        light.radiance,
                                        map == nullptr ? nullptr : &map->light,
                                        {nullptr, nullptr}});
        if (light.portal.size() > 0) add_portal(light, map, *environments, environments->lights.back());
    }
    return {environments, environments->lights.data()};
}

} // namespace nusselt::render_cpu
