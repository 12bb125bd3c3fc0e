#include "render_cpu/lights/environment_records.h"

#include "render_cpu/lights/polygon_corners.h"
#include "scene/model/library_vector.h"
#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/environment_map.h>
#include <nusselt/emission/windowed_light.h>

#include <algorithm>
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

/// Columns and rows of tables of portals, at most.
constexpr int kMostTexels = 1024;
/// Texels of such a table whose parts have weights: 0.5 MB.
constexpr int kMostRefinedTexels = 2048;

/// A map with as many texels as tables can show: means over squares of texels, where it has more.
struct ReducedMap {
    explicit ReducedMap(const OctahedralMap<float>& map) : radiance(map) {
        const int factor = map.size / kMostTexels;
        if (factor <= 1) return;
        const float share = 1 / static_cast<float>(factor * factor);
        texels.resize(static_cast<std::size_t>(kMostTexels) * kMostTexels);
        for (int j = 0; j < map.size; ++j)
            for (int i = 0; i < map.size; ++i)
                texels[static_cast<std::size_t>(j / factor * kMostTexels + i / factor)] +=
                    share * map.texel[j * map.size + i];
        radiance = {texels.data(), kMostTexels};
    }

    std::vector<Vec3<float>> texels;
    OctahedralMap<float> radiance;
};

/// A portal for points on one side of it.
struct PreparedPortal {
    /// \param frame    its normal leads away from these points
    /// \param map_size columns and rows of the map
    /// \param radiance of a direction in world space
    template <class Radiance>
    PreparedPortal(const std::vector<Vec3<float>>& vertices, const Frame<float>& frame, int map_size,
                   const Radiance& radiance) {
        // The map varies within texels of the table, which remains as noise: they are half as large as those of the map.
        const int texels = std::clamp(2 * map_size, 16, kMostTexels);
        // An interpolated peak of a single texel is two texels wide, so that some lookup finds it.
        constexpr int kLookups = 2;
        sums.resize(static_cast<std::size_t>(RectifiedTable<float>::size(texels, texels)));
        colour.resize(sums.size());
        const auto in_frame = [&](const Vec3<float>& direction) {
            return radiance(frame.to_world(direction));
        };
        auto table = make_rectified_table<float>(in_frame, RectifiedDomain<float>::hemisphere(), texels,
                                                 texels, kLookups, sums.data(), colour.data());
        // The edge of a sun is still steep in such texels.
        refined.resize(kMostRefinedTexels);
        weights.resize(refined.size() * RefinedTexels<float>::kSize);
        refine_rectified_table<float>(in_frame, table, kMostRefinedTexels, refined.data(), weights.data());
        light = make_portal(frame, vertices.data(), static_cast<int>(vertices.size()), table);
    }

    std::vector<RectifiedSums> sums;
    std::vector<Vec3<float>> colour;
    std::vector<std::int32_t> refined;
    std::vector<float> weights;
    WindowedLight<float> light{};
};

struct Environments {
    std::vector<EnvironmentRecord> lights;
    std::deque<PreparedMap> maps;
    std::deque<PreparedPortal> portals;
    std::deque<PolygonCorners> corners;
};

/// The frame of a portal, with its first axis along the longest side: rectangles then have both along their sides.
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

void add_tables(const scene::EnvironmentLight& light, const PreparedMap& map, Environments& environments,
                EnvironmentRecord& record) {
    std::vector<Vec3<float>> vertices;
    for (const scene::Float3& vertex : light.portal) vertices.push_back(scene::to_vec(vertex));
    const Frame<float> frame = frame_of(vertices);
    const Frame<float> back{frame.t, -frame.b, -frame.n};
    const ReducedMap reduced(map.light.radiance);
    const auto along = [](const scene::Float3& axis, const Vec3<float>& w) {
        return dot(scene::to_vec(axis), w);
    };
    const auto radiance = [&](const Vec3<float>& w) {
        return reduced.radiance.lookup(
            Vec3<float>{along(light.x_axis, w), along(light.y_axis, w), along(light.z_axis, w)});
    };
    const int size = reduced.radiance.size;
    record.portal[0] = &environments.portals.emplace_back(vertices, frame, size, radiance).light;
    record.portal[1] = &environments.portals.emplace_back(vertices, back, size, radiance).light;
}

EnvironmentRecord record_of(const scene::EnvironmentLight& light, const PreparedMap* map,
                            Environments& environments) {
    EnvironmentRecord record{};
    record.x_axis = light.x_axis;
    record.y_axis = light.y_axis;
    record.z_axis = light.z_axis;
    record.radiance = light.radiance;
    if (map != nullptr) record.map = &map->light;
    if (light.portal.size() == 0) return record;
    const PolygonCorners& corners = environments.corners.emplace_back(light.portal);
    record.corners = corners.corners.data();
    record.normal = corners.normal;
    record.slots = corners.slots;
    if (map != nullptr) add_tables(light, *map, environments, record);
    return record;
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
        environments->lights.push_back(record_of(light, map, *environments));
    }
    return {environments, environments->lights.data()};
}

} // namespace nusselt::render_cpu
