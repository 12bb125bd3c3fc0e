#include "scene/build/lights/emission_warnings.h"

#include "scene/model/limits.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/vector_math.h"

#include <algorithm>

namespace nusselt::scene {

namespace {

Darkness darkness(const Scene& scene, std::int32_t texture, std::int32_t profile) {
    if (profile >= 0) return darkness(scene.emission_profiles[static_cast<std::size_t>(profile)]);
    if (texture < 0) return std::nullopt;
    const TexturedEmission& emission = scene.emission_textures[static_cast<std::size_t>(texture)];
    return is_black(emission.mean) ? Darkness(black_image(emission.texture->name)) : std::nullopt;
}

Darkness darkness(const Scene& scene, const PolygonLight& light) {
    return darkness(scene, light.texture, light.profile);
}
Darkness darkness(const Scene& scene, const LineLight& light) {
    return darkness(scene, light.texture, light.profile);
}

Darkness darkness(const Scene& scene, const PointLight& light) {
    if (light.distribution == PointDistribution::profile)
        return darkness(*scene.luminaires[static_cast<std::size_t>(light.profile)]);
    if (!is_image(light.distribution) || light.texture < 0 || !is_black(light.image_integral))
        return std::nullopt;
    return black_image(scene.textures[static_cast<std::size_t>(light.texture)].name);
}

Darkness darkness(const Scene& scene, const EnvironmentLight& light) {
    if (light.map < 0) return std::nullopt;
    const EnvironmentMapTexels& map = *scene.environment_maps[static_cast<std::size_t>(light.map)];
    return is_black(map.mean) ? Darkness(black_image(map.name)) : std::nullopt;
}

/// The reasons of some lights.
struct Reasons {
    std::size_t count = 0;
    Darkness first;

    template <class Light>
    void add(const Scene& scene, const std::vector<Light>& lights) {
        for (const Light& light : lights) {
            const Darkness reason = darkness(scene, light);
            if (reason && count++ == 0) first = reason;
        }
    }
};

} // namespace

std::string black_image(std::string_view name) {
    return "it emits no light because what it shows of the image '" + std::string(shortened(name)) +
           "' is black (below " + to_text(kDarkest) + ")";
}

Darkness darkness(const Luminaire& luminaire) {
    if (luminaire.profile.peak().candelas > 0) return std::nullopt;
    return "it emits no light because its profile '" + luminaire.name + "' is black (below " +
           to_text(kDarkest) + " cd)";
}

Darkness darkness(const ProfiledEmission& emission) {
    if (emission.mean > 0) return std::nullopt;
    const EmissionProfile& profile = *emission.profile;
    if (profile.luminaire == nullptr)
        return "it emits no light because nothing passes its spread or honeycomb";
    if (Darkness black = darkness(*profile.luminaire)) return black;
    const bool has_grid = spread_slope(profile) || honeycomb_slopes(profile);
    return "it emits no light because its profile '" + profile.luminaire->name + "' " +
           (!(profile.lost < 1) ? "emits nothing on the sides on which it shines"
            : has_grid          ? "emits nothing in the directions that its spread or honeycomb lets pass"
                                : "is too weak for its area (below " + to_text(kDarkest) + " cd/m^2)");
}

Darkness darkness(const Scene& scene, const Lights& parts) {
    // Lights of other kinds have nothing that could be to blame.
    Reasons reasons;
    reasons.add(scene, parts.of<PolygonLight>());
    reasons.add(scene, parts.of<LineLight>());
    reasons.add(scene, parts.of<PointLight>());
    reasons.add(scene, parts.of<EnvironmentLight>());
    return reasons.count == parts.size() ? reasons.first : std::nullopt;
}

void warn_of_darkness(const Location& origin, const std::string& subject, const std::string& clause,
                      Warnings& warnings) {
    // Each light counts, not only the first one with this reason.
    warnings.add(origin, to_string(origin) + ": " + clause, subject + ": " + clause);
}

void make_dark(const ShapeDescription& shape, const std::string& clause, BuiltShape& built) {
    warn_of_darkness(shape.origin, subject_of(shape), clause, built.warnings);
    built.lights.clear();
    built.emission_textures.clear();
    built.emission_profiles.clear();
    std::fill(built.triangle_light.begin(), built.triangle_light.end(), -1);
}

} // namespace nusselt::scene
