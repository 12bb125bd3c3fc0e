#include "render_cpu/lights/environment_records.h"

#include "render_cpu/lights/polygon_corners.h"
#include "scene/model/library_vector.h"
#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/environment_map.h>
#include <nusselt/emission/windowed_light.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <map>
#include <tuple>
#include <utility>
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

/// What a portal shows to points on one side of it.
struct PreparedTable {
    /// \param in_frame radiance of a direction in the frame of the portal
    /// \param map_size columns and rows of the map
    template <class Radiance>
    PreparedTable(const Radiance& in_frame, int map_size) {
        // The map varies within texels of the table, which remains as noise: they are half as large as those of the map.
        const int texels = std::clamp(2 * map_size, 16, kMostTexels);
        // An interpolated peak of a single texel is two texels wide, so that some lookup finds it.
        constexpr int kLookups = 2;
        sums.resize(static_cast<std::size_t>(RectifiedTable<float>::size(texels, texels)));
        colour.resize(sums.size());
        table = make_rectified_table<float>(in_frame, RectifiedDomain<float>::hemisphere(), texels, texels,
                                            kLookups, sums.data(), colour.data());
        // The edge of a sun is still steep in such texels.
        refined.resize(kMostRefinedTexels);
        weights.resize(refined.size() * RefinedTexels<float>::kSize);
        refine_rectified_table<float>(in_frame, table, kMostRefinedTexels, refined.data(), weights.data());
    }

    std::vector<RectifiedSums> sums;
    std::vector<Vec3<float>> colour;
    std::vector<std::int32_t> refined;
    std::vector<float> weights;
    RectifiedTable<float> table{};
};

/// Components of axes that differ by less have the same table. It gives probabilities only.
constexpr float kSameNumber = 1e-5f;

/// A map with a radiance. Lights that share both share what is prepared.
using MapKey = std::tuple<const scene::EnvironmentMapTexels*, float, float, float>;
/// The map, and the frame of a portal in the space of the map as multiples of kSameNumber.
using TableKey = std::pair<const PreparedMap*, std::array<std::int32_t, 9>>;

struct Environments {
    std::vector<EnvironmentRecord> lights;
    std::map<MapKey, PreparedMap> maps;
    std::map<TableKey, PreparedTable> tables;
    std::deque<WindowedLight<float>> portals;
    std::deque<PolygonCorners> corners;
};

/// Of both directions of an axis, the one that leads to larger components.
Vec3<float> forward(const Vec3<float>& axis) {
    const Vec3<float> size{std::fabs(axis.x), std::fabs(axis.y), std::fabs(axis.z)};
    const float largest = std::max({size.x, size.y, size.z});
    const float component = size.x == largest ? axis.x : size.y == largest ? axis.y : axis.z;
    return component < 0 ? -axis : axis;
}

/// The frame of a portal, with its first axis along the longest side: rectangles then have both along their sides. Rectangles
/// with the same directions have the same frame, or that of the other side.
Frame<float> frame_of(const std::vector<Vec3<float>>& vertices) {
    constexpr float kLonger = 1.0001f; // squares have no longest side
    Vec3<float> longest{0, 0, 0};
    Vec3<float> normal{0, 0, 0};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3<float> side = vertices[(i + 1) % vertices.size()] - vertices[i];
        if (dot(side, side) > kLonger * dot(longest, longest)) longest = side;
        if (i >= 2) normal += cross(vertices[i - 1] - vertices[0], vertices[i] - vertices[0]);
    }
    const Vec3<float> n = normalize(normal);
    const Vec3<float> t = forward(normalize(longest - dot(n, longest) * n));
    return {t, cross(n, t), n};
}

/// What a portal shows to the side from which the normal of its frame leads away.
const RectifiedTable<float>& find_table(const scene::EnvironmentLight& light, const PreparedMap& map,
                                        const Frame<float>& frame, Environments& environments) {
    const auto to_map = [&](const Vec3<float>& w) {
        return Vec3<float>{dot(scene::to_vec(light.x_axis), w), dot(scene::to_vec(light.y_axis), w),
                           dot(scene::to_vec(light.z_axis), w)};
    };
    TableKey key{&map, {}};
    std::size_t at = 0;
    for (const Vec3<float>& axis : {to_map(frame.t), to_map(frame.b), to_map(frame.n)})
        for (const float component : {axis.x, axis.y, axis.z})
            key.second[at++] = static_cast<std::int32_t>(std::lround(component / kSameNumber));
    const auto found = environments.tables.find(key);
    if (found != environments.tables.end()) return found->second.table;
    const ReducedMap reduced(map.light.radiance);
    const auto in_frame = [&](const Vec3<float>& w) {
        return reduced.radiance.lookup(to_map(frame.to_world(w)));
    };
    return environments.tables.try_emplace(key, in_frame, reduced.radiance.size).first->second.table;
}

void add_portals(const scene::EnvironmentLight& light, const PreparedMap& map, Environments& environments,
                 EnvironmentRecord& record) {
    std::vector<Vec3<float>> vertices;
    for (const scene::Float3& vertex : light.portal) vertices.push_back(scene::to_vec(vertex));
    const Frame<float> front = frame_of(vertices);
    const Frame<float> back{front.t, -front.b, -front.n};
    const auto add = [&](const Frame<float>& frame) {
        return &environments.portals.emplace_back(make_portal(frame, vertices.data(),
                                                              static_cast<int>(vertices.size()),
                                                              find_table(light, map, frame, environments)));
    };
    record.portal[0] = add(front);
    record.portal[1] = add(back);
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
    if (map != nullptr) add_portals(light, *map, environments, record);
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
        if (light.map >= 0) {
            const scene::EnvironmentMapTexels& texels =
                *scene.environment_maps.at(static_cast<std::size_t>(light.map));
            const scene::Float3& radiance = light.radiance;
            map = &environments->maps
                       .try_emplace({&texels, radiance.x, radiance.y, radiance.z}, texels, radiance)
                       .first->second;
        }
        environments->lights.push_back(record_of(light, map, *environments));
    }
    return {environments, environments->lights.data()};
}

} // namespace nusselt::render_cpu
