#include "render_cpu/lights/point_records.h"

#include "render_cpu/lights/luminaire_tables.h"
#include "scene/model/profiles/luminaire.h"
#include "scene/model/scene.h"

#include <vector>

namespace nusselt::render_cpu {

namespace {

struct PointArrays {
    std::vector<PointRecord> lights;
    LuminaireTables luminaires;
};

PointRecord make_record(const scene::Scene& scene, const scene::PointLight& light, LuminaireTables& tables) {
    const scene::ConeFalloff falloff = cone_falloff(light);
    LuminaireTable luminaire{};
    if (light.distribution == scene::PointDistribution::profile) {
        const auto& measured = scene.luminaires.at(static_cast<std::size_t>(light.profile));
        luminaire = tables.add(measured, measured->profile.peak().candelas);
    }
    return {light.position,
            light.x_axis,
            light.y_axis,
            light.z_axis,
            light.intensity,
            light.distribution,
            static_cast<float>(falloff.end),
            scene::inverse_width(falloff),
            light.half_extent,
            luminaire,
            light.texture};
}

} // namespace

std::shared_ptr<const void> make_point_records(const scene::Scene& scene, const scene::LightList& list) {
    const auto* const lights = dynamic_cast<const scene::LightsOf<scene::PointLight>*>(&list);
    if (lights == nullptr) return nullptr;
    const auto arrays = std::make_shared<PointArrays>();
    for (const scene::PointLight& light : lights->lights)
        arrays->lights.push_back(make_record(scene, light, arrays->luminaires));
    return {arrays, arrays->lights.data()};
}

} // namespace nusselt::render_cpu
