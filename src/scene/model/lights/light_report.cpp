#include "scene/model/lights/light_report.h"

#include "scene/model/lights/light_text.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <ostream>

namespace nusselt::scene {

namespace {

/// The power in the strongest channel [W].
double power(const LightList& list, std::size_t i, double scene_radius) {
    const Double3 flux =
        per_channel_product(list.flux_per_emission(i, scene_radius), to_double(list.emission(i)));
    return std::max({flux.x, flux.y, flux.z});
}

/// Reports lights that cost as much time as others but contribute next to nothing.
void write_weak_lights(const LightList& list, double scene_radius, std::ostream& stream) {
    constexpr double kWeak = 1e-6;
    double total = 0;
    for (std::size_t i = 0; i < list.size(); ++i) total += power(list, i, scene_radius);
    std::size_t weak = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
        weak += power(list, i, scene_radius) < kWeak * total ? 1 : 0;
    if (weak == 0) return;
    stream << "  " << weak << " of the " << list.plural() << (weak == 1 ? " has" : " have") << " less than "
           << report_text(kWeak) << " of the power of all\n";
}

/// What is to be said of the profile of a light; nothing if it has none.
std::string profile_text(const Scene& scene, const LightList& list, std::size_t i) {
    if (const auto* const points = dynamic_cast<const LightsOf<PointLight>*>(&list)) {
        const std::int32_t luminaire = points->lights[i].profile;
        return luminaire < 0 ? "" : ", " + scene.luminaires[static_cast<std::size_t>(luminaire)]->name;
    }
    std::int32_t index = -1;
    if (const auto* const polygons = dynamic_cast<const LightsOf<PolygonLight>*>(&list))
        index = polygons->lights[i].profile;
    if (const auto* const lines = dynamic_cast<const LightsOf<LineLight>*>(&list))
        index = lines->lights[i].profile;
    if (index < 0) return "";
    const EmissionProfile& profile = *scene.emission_profiles[static_cast<std::size_t>(index)].profile;
    std::string text;
    if (profile.luminaire != nullptr)
        text +=
            ", " + profile.luminaire->name + " without " + report_text(100 * profile.lost) + " % of its flux";
    if (profile.spread < kWidestSpread) text += ", spread " + report_text(profile.spread) + " degrees";
    if (profile.honeycomb != HoneycombAngles{})
        text += ", honeycomb " + report_text(profile.honeycomb.along) + " x " +
                report_text(profile.honeycomb.across) + " degrees, which passes " +
                report_text(100 * passed_flux(profile)) + " % of light that is alike in all directions";
    return text;
}

} // namespace

void write_light_report(const Scene& scene, std::ostream& stream) {
    const char* separator = "";
    for (const LightList& list : scene.lights) {
        if (list.size() == 0) continue;
        stream << separator << list.size() << " " << list.name() << (list.size() == 1 ? " light" : " lights");
        separator = ", ";
    }
    stream << (scene.lights.empty() ? "no lights\n" : "\n");
    for (const LightList& list : scene.lights) {
        for (std::size_t begin = 0, end = 0; begin < list.size(); begin = end) {
            while (end < list.size() && list.emitter(end) == list.emitter(begin)) ++end;
            stream << "  " << scene.emitters[list.emitter(begin)].name << ": "
                   << list.describe(begin, end, scene.radius) << profile_text(scene, list, begin) << "\n";
        }
        write_weak_lights(list, scene.radius, stream);
    }
}

} // namespace nusselt::scene
