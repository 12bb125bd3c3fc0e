#include "scene/rig/light_profile.h"

#include "scene/colour/colour_space.h"
#include "scene/model/profiles/profile_radiance.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace nusselt::scene {

namespace {

/// A colour with the luminance 1; white for black.
Double3 colour_of(const Float3& emission) {
    const Double3 colour = to_double(emission);
    const double brightness = luminance(colour);
    return brightness > 0 ? (1 / brightness) * colour : Double3{1, 1, 1};
}

/// \returns whether the shape can have a profile
bool fit(const ProfileRequest& request, bool is_measured, Scene& scene, std::vector<PolygonLight>& lights) {
    std::optional<ProfiledShape> shape = profile_shape(lights, 0, request);
    if (!shape) return false;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].profile = static_cast<std::int32_t>(scene.emission_profiles.size());
        scene.emission_profiles.push_back(std::move(shape->emissions[i]));
        if (is_measured) lights[i].radiance = to_float(shape->radiance[i] * colour_of(lights[i].radiance));
    }
    return true;
}

/// Lets a point light shine as a luminaire. Without an axis of its own it shines along -y, with the half-plane of 0 degrees
/// along x.
void set_luminaire(const std::shared_ptr<const Luminaire>& luminaire, double angle, Scene& scene,
                   PointLight& light) {
    const bool has_axis = light.distribution != PointDistribution::isotropic;
    const Double3 z = has_axis ? to_double(light.z_axis) : Double3{0, -1, 0};
    const Double3 reference = std::fabs(z.x) < 0.9 ? Double3{1, 0, 0} : Double3{0, 0, 1};
    const Double3 plain = normalized(reference - dot(reference, z) * z);
    const double turn = angle * (std::numbers::pi / 180);
    const Double3 x = std::cos(turn) * plain + std::sin(turn) * cross(z, plain);
    light.x_axis = to_float(x);
    light.y_axis = to_float(cross(z, x));
    light.z_axis = to_float(z);
    const auto found = std::find(scene.luminaires.begin(), scene.luminaires.end(), luminaire);
    light.profile = static_cast<std::int32_t>(found - scene.luminaires.begin());
    if (found == scene.luminaires.end()) scene.luminaires.push_back(luminaire);
    set_profile(*luminaire, light);
    light.texture = -1;
    light.intensity =
        to_float((luminaire->profile.peak().candelas / kLumensPerWatt) * colour_of(light.intensity));
}

bool is_same(const std::shared_ptr<const Luminaire>& a, const std::shared_ptr<const Luminaire>& b) {
    return a == b || (a != nullptr && b != nullptr && a->path == b->path);
}

} // namespace

LightProfile profile_of(const Scene& scene, const EditableLight& light) {
    for (const PolygonLight& polygon : light.parts.of<PolygonLight>()) {
        if (polygon.profile < 0) continue;
        const ProfiledEmission& emission = scene.emission_profiles[static_cast<std::size_t>(polygon.profile)];
        const Float3& x = emission.x_axis;
        const double angle = std::atan2(double{x.y}, double{x.x}) * (180 / std::numbers::pi);
        return {emission.profile->luminaire, emission.profile->spread, angle};
    }
    for (const PointLight& point : light.parts.of<PointLight>())
        if (point.distribution == PointDistribution::profile)
            return {scene.luminaires[static_cast<std::size_t>(point.profile)]};
    return {};
}

std::optional<ProfileDefect> change_profile(const GivenProfile& given, Scene& scene, EditableLight& light) {
    if (given.is_empty()) return std::nullopt;
    const LightProfile before = profile_of(scene, light);
    const bool is_same_luminaire = given.luminaire == nullptr || is_same(given.luminaire, before.luminaire);
    if (is_same_luminaire && !given.angle && given.spread.value_or(before.spread) == before.spread)
        return std::nullopt;
    const std::string field = given.luminaire != nullptr ? "ies" : "spread";
    std::vector<PolygonLight>& polygons = light.parts.of<PolygonLight>();
    std::vector<PointLight>& points = light.parts.of<PointLight>();
    if (polygons.size() + points.size() != light.parts.size())
        return ProfileDefect{field,
                             "only polygons and points can have a profile, and only polygons a spread"};
    if (!points.empty() && given.spread) return ProfileDefect{"spread", "only polygons have a spread"};
    for (PointLight& point : points) set_luminaire(given.luminaire, given.angle.value_or(0), scene, point);
    if (polygons.empty()) return std::nullopt;
    if (polygons.front().texture >= 0)
        return ProfileDefect{field, "a light that emits an image has neither a profile nor a spread"};
    const ProfileRequest request{given.luminaire != nullptr ? given.luminaire : before.luminaire,
                                 given.spread.value_or(before.spread),
                                 given.angle.value_or(given.luminaire != nullptr ? 0 : before.angle)};
    if (!fit(request, given.luminaire != nullptr, scene, polygons))
        return ProfileDefect{field, "a light with more than " + std::to_string(kMostLuminousFaces) +
                                        " normals cannot have a profile"};
    return std::nullopt;
}

void refit_profile(Scene& scene, EditableLight& light) {
    const LightProfile profile = profile_of(scene, light);
    if (profile.luminaire == nullptr && profile.spread == kWidestSpread) return;
    std::vector<PolygonLight>& polygons = light.parts.of<PolygonLight>();
    if (!polygons.empty()) fit({profile.luminaire, profile.spread, profile.angle}, false, scene, polygons);
}

} // namespace nusselt::scene
