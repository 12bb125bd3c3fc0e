#include "scene/build/lights/profiled_light.h"

#include "scene/build/lights/emission_warnings.h"
#include "scene/model/profiles/line_profile.h"
#include "scene/model/profiles/profile_radiance.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>

namespace nusselt::scene {

namespace {

/// The edge of a polygon that begins at a point, or else the first one.
std::size_t edge_from(const PolygonLight& light, const Float3& point) {
    const auto* const found = std::find(light.vertices.begin(), light.vertices.end(), point);
    return found == light.vertices.end() ? 0 : static_cast<std::size_t>(found - light.vertices.begin());
}

/// The area of a light with all its sides [m^2].
double whole_area(const PolygonLight& light) { return (light.two_sided ? 2 : 1) * area(light); }
double whole_area(const LineLight& light) { return area(light); }

/// The radiance of each light.
template <class Light>
std::vector<Float3> radiances(const Emission& emission, const Location& origin, const std::string& subject,
                              const std::vector<Light>& lights, const ProfiledShape& profiled) {
    double all = 0;
    double power = 0; // as measured, for a colour with the luminance 1
    for (std::size_t i = 0; i < lights.size(); ++i) {
        all += area(lights[i]);
        if (!profiled.radiance.empty())
            power += std::numbers::pi * whole_area(lights[i]) * profiled.radiance[i];
    }
    if (profiled.radiance.empty())
        return std::vector<Float3>(lights.size(), radiance_of(emission, all, subject, origin));
    const double factor = !emission.power ? 1 : power > 0 ? *emission.power / power : 0;
    std::vector<Float3> result;
    for (const double radiance : profiled.radiance) {
        result.push_back(to_float(factor * radiance * to_double(emission.radiance)));
        check_radiance(result.back(), subject, origin);
    }
    return result;
}

/// Where a shape does not emit, and which one would.
std::string loss_of(const EmissionProfile& profile) {
    if (profile.round.area > 0) return "leaves along the tube; a thicker closed tube or a point could";
    switch (profile.faces.size()) {
    case 1:
        return "leaves upward or along the light; a box or a point could";
    case 2:
        return "leaves where the shape shows its edge; a closed box or a point could";
    default:
        return "leaves where the shape has no face; a closed box or a point could";
    }
}

/// Why none of the lights of a shape emits anything.
Darkness darkness(const ProfiledShape& profiled) {
    for (const ProfiledEmission& emission : profiled.emissions)
        if (!darkness(emission)) return std::nullopt;
    return darkness(profiled.emissions.front());
}

void warn_of_lost_flux(const ShapeDescription& shape, const EmissionProfile& profile, Warnings& warnings) {
    constexpr double kWorthMentioning = 0.01;
    if (profile.luminaire == nullptr || !(profile.lost > kWorthMentioning)) return;
    warnings.add(shape.origin, "flux that a shape cannot emit",
                 subject_of(shape) + ": it cannot emit " + to_text(0.1 * std::round(1000 * profile.lost)) +
                     " % of the flux of '" + profile.luminaire->name + "', which " + loss_of(profile));
}

} // namespace

Emission without_profile(const Emission& emission) {
    Emission result = emission;
    result.profile = {};
    if (emission.profile != nullptr && emission.profile->luminaire != nullptr && !emission.power)
        result.power = emission.profile->luminaire->profile.flux() / kLumensPerWatt;
    return result;
}

void warn_of_too_many_normals(const ShapeDescription& shape, Warnings& warnings) {
    warnings.add(shape.origin, "profiles of round shapes",
                 subject_of(shape) + ": it has more than " + std::to_string(kMostLuminousFaces) +
                     " normals, too many for a profile; it emits as much light alike in all directions");
}

void add_profiled_polygons(const ShapeDescription& shape, const FormatWords& words,
                           PolygonPartition&& partition, BuiltShape& built) {
    std::vector<PolygonLight> lights;
    for (PolygonVertices& polygon : partition.polygons)
        lights.push_back({.vertices = std::move(polygon), .two_sided = shape.emission.two_sided});
    const Float3& first = built.positions[built.triangles.front().vertex[0]];
    std::optional<ProfiledShape> profiled =
        profile_shape(lights, edge_from(lights.front(), first), *shape.emission.profile);
    built.triangle_light = std::move(partition.polygon_of_triangle);
    const std::shared_ptr<const Luminaire>& luminaire = shape.emission.profile->luminaire;
    Darkness dark;
    if (profiled)
        dark = darkness(*profiled);
    else if (luminaire != nullptr)
        dark = darkness(*luminaire);
    if (dark) {
        make_dark(shape, *dark, built);
        return;
    }
    if (profiled) {
        const std::vector<Float3> radiance =
            radiances(shape.emission, shape.origin, words.emission, lights, *profiled);
        for (std::size_t i = 0; i < lights.size(); ++i) {
            lights[i].radiance = radiance[i];
            lights[i].profile = static_cast<std::int32_t>(i);
        }
        warn_of_lost_flux(shape, *profiled->emissions.front().profile, built.warnings);
        built.emission_profiles = std::move(profiled->emissions);
    } else {
        warn_of_too_many_normals(shape, built.warnings);
        const Float3 radiance =
            radiance_of(without_profile(shape.emission), area(built), words.emission, shape.origin);
        for (PolygonLight& light : lights) light.radiance = radiance;
    }
    built.lights.of<PolygonLight>() = std::move(lights);
}

void add_profiled_line(const ShapeDescription& shape, const FormatWords& words, LineLight light,
                       BuiltShape& built) {
    ProfiledShape profiled = profile_line(light, *shape.emission.profile);
    if (const Darkness dark = darkness(profiled.emissions.front())) {
        make_dark(shape, *dark, built);
        return;
    }
    Emission outwards = shape.emission;
    outwards.two_sided = false;
    light.radiance = radiances(outwards, shape.origin, words.emission, std::vector{light}, profiled).front();
    light.profile = 0;
    warn_of_lost_flux(shape, *profiled.emissions.front().profile, built.warnings);
    built.emission_profiles = std::move(profiled.emissions);
    built.lights.of<LineLight>() = {light};
}

} // namespace nusselt::scene
