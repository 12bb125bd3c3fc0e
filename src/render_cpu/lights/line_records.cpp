#include "render_cpu/lights/line_records.h"

#include "render_cpu/lights/light_kernel.h"
#include "render_cpu/lights/profile_records.h"
#include "scene/model/library_vector.h"
#include "scene/model/lights/line_radiance.h"
#include "scene/model/profiles/line_profile.h"
#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <nusselt/geometry/line_segment.h>
#include <nusselt/line_emission/textured_line.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>
#include <tuple>
#include <vector>

namespace nusselt::render_cpu {

namespace {

using Profile = LineProfile<float, scene::kMaxLineTexels>;

struct LineArrays {
    std::vector<LineRecord> lights;
    std::vector<std::unique_ptr<const Profile>> profiles;
    ProfileRecords records;
    std::deque<LineProfileRecord> directions;
};

LineRecord make_record(const scene::LineLight& light) {
    const auto line = make_line(to_vec(light.start), to_vec(light.end));
    return {scene::to_float3(line.p0),
            scene::to_float3(line.s),
            line.length,
            light.radius,
            light.model,
            light.normal,
            light.radiance,
            scene::to_float3(light.radius * to_vec(light.radiance)),
            scene::per_channel_ratio({1, 1, 1}, light.radiance),
            nullptr,
            nullptr};
}

LineProfileRecord make_directions(const scene::Scene& scene, const scene::LineLight& light,
                                  ProfileRecords& records) {
    static_assert(std::tuple_size_v<scene::TubeSpread> == kTubeSpreadCells + 1);
    const auto& emission = scene.emission_profiles.at(static_cast<std::size_t>(light.profile));
    LineProfileRecord record{records.make(emission, place_profile(light, emission)), {}};
    if (const std::optional<double> slope = spread_slope(*emission.profile)) {
        const scene::TubeSpread table = scene::tube_spread(*slope);
        std::copy(table.begin(), table.end(), record.spread);
    }
    return record;
}

} // namespace

std::shared_ptr<const void> make_line_records(const scene::Scene& scene, const scene::LightList& list) {
    const auto* const lines = dynamic_cast<const scene::LightsOf<scene::LineLight>*>(&list);
    if (lines == nullptr) return nullptr;
    const auto arrays = std::make_shared<LineArrays>();
    for (const scene::LineLight& light : lines->lights) {
        arrays->lights.push_back(make_record(light));
        if (light.profile >= 0)
            arrays->lights.back().directions =
                &arrays->directions.emplace_back(make_directions(scene, light, arrays->records));
        if (light.texture < 0) continue;
        const auto& emission = scene.emission_textures.at(static_cast<std::size_t>(light.texture));
        arrays->profiles.push_back(std::make_unique<const Profile>(radiance_along(light, emission)));
        arrays->lights.back().profile = arrays->profiles.back().get();
    }
    return {arrays, arrays->lights.data()};
}

} // namespace nusselt::render_cpu
