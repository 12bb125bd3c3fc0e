#include "scene/rig/light_profile.h"

#include "scene/colour/colour_space.h"
#include "scene/model/profiles/line_profile.h"
#include "scene/model/profiles/profile_radiance.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <utility>

namespace nusselt::scene {

namespace {

/// Where the luminaires of lights without an axis shine to.
constexpr Double3 kDown = {0, -1, 0};

/// The emission of a light with a luminaire, by what it was and by what was measured for a colour of the luminance 1.
using EmissionRule = std::function<Float3(const Float3& before, double measured)>;

Float3 keep(const Float3& before, double /*measured*/) { return before; }

/// Measured, in the old colour; white for black.
Float3 as_measured(const Float3& before, double measured) {
    const Double3 colour = to_double(before);
    const double brightness = luminance(colour);
    return to_float(measured * (brightness > 0 ? (1 / brightness) * colour : Double3{1, 1, 1}));
}

/// \returns whether the shape can have a profile
bool fit(const ProfileRequest& request, const EmissionRule& rule, Scene& scene,
         std::vector<PolygonLight>& lights) {
    if (lights.empty()) return true;
    std::optional<ProfiledShape> shape = profile_shape(lights, 0, request);
    if (!shape) return false;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].profile = static_cast<std::int32_t>(scene.emission_profiles.size());
        scene.emission_profiles.push_back(std::move(shape->emissions[i]));
        if (!shape->radiance.empty()) lights[i].radiance = rule(lights[i].radiance, shape->radiance[i]);
    }
    return true;
}

void fit(const ProfileRequest& request, const EmissionRule& rule, const Double3& axis, Scene& scene,
         LineLight& light) {
    if (is_black(light.normal)) light.normal = perpendicular_to_line(light, axis);
    ProfiledShape shape = profile_line(light, request);
    light.profile = static_cast<std::int32_t>(scene.emission_profiles.size());
    scene.emission_profiles.push_back(std::move(shape.emissions.front()));
    if (!shape.radiance.empty()) light.radiance = rule(light.radiance, shape.radiance.front());
}

double measured_intensity(const Luminaire& luminaire) {
    return luminaire.profile.peak().candelas / kLumensPerWatt;
}

/// Lets a point light shine as a luminaire, with the half-plane of 0 degrees along x.
/// \param axis of a light without one
void fit(const ProfileRequest& request, const EmissionRule& rule, const Double3& axis, Scene& scene,
         PointLight& light) {
    const bool has_axis = light.distribution != PointDistribution::isotropic;
    const Double3 z = has_axis ? to_double(light.z_axis) : axis;
    const Axes axes =
        Axes::of(std::fabs(z.x) < 0.9 ? Double3{1, 0, 0} : Double3{0, 0, 1}, z).turned(request.angle);
    light.x_axis = to_float(axes.x);
    light.y_axis = to_float(axes.y);
    light.z_axis = to_float(axes.z);
    const auto found = std::find(scene.luminaires.begin(), scene.luminaires.end(), request.luminaire);
    light.profile = static_cast<std::int32_t>(found - scene.luminaires.begin());
    if (found == scene.luminaires.end()) scene.luminaires.push_back(request.luminaire);
    set_profile(*request.luminaire, light);
    light.texture = -1;
    light.intensity = rule(light.intensity, measured_intensity(*request.luminaire));
}

bool is_same(const std::shared_ptr<const Luminaire>& a, const std::shared_ptr<const Luminaire>& b) {
    return a == b || (a != nullptr && b != nullptr && a->path == b->path);
}

/// The request that a rig makes of a light with a profile. A spread and a honeycomb replace each other.
ProfileRequest requested(const GivenProfile& given, const LightProfile& before) {
    ProfileRequest request = before;
    if (given.luminaire != nullptr) request.luminaire = given.luminaire;
    if (given.spread) request.spread = *given.spread;
    if (given.spread && *given.spread < kWidestSpread) request.honeycomb = {};
    if (given.honeycomb) request.honeycomb = *given.honeycomb;
    if (given.honeycomb && *given.honeycomb != HoneycombAngles{}) request.spread = kWidestSpread;
    if (given.angle) request.angle = *given.angle;
    return request;
}

/// Why a light cannot have a profile, and the field that asks for it; nothing if it can.
std::optional<FieldDefect> find_defect(const GivenProfile& given, const EditableLight& light) {
    const std::string field = given.luminaire != nullptr ? "ies"
                              : given.spread             ? "spread"
                              : given.honeycomb          ? "honeycomb"
                                                         : "ies_degrees";
    const auto& polygons = light.parts.of<PolygonLight>();
    const auto& lines = light.parts.of<LineLight>();
    const auto& points = light.parts.of<PointLight>();
    if (polygons.size() + lines.size() + points.size() != light.parts.size())
        return FieldDefect{field, "only polygons, tubes, lines and points can have a profile, only "
                                  "those with an area a spread, and only polygons a honeycomb"};
    if (!points.empty() && given.spread) return FieldDefect{"spread", "points have no spread"};
    if (polygons.size() != light.parts.size() && given.honeycomb)
        return FieldDefect{"honeycomb", "only polygons have a honeycomb"};
    const auto has_image = [](const auto& part) { return part.texture >= 0; };
    if (std::any_of(polygons.begin(), polygons.end(), has_image) ||
        std::any_of(lines.begin(), lines.end(), has_image))
        return FieldDefect{field, "a light that emits an image has no profile, spread or honeycomb"};
    return std::nullopt;
}

LightProfile profile_in(const Scene& scene, std::int32_t index) {
    const ProfiledEmission& emission = scene.emission_profiles[static_cast<std::size_t>(index)];
    const EmissionProfile& profile = *emission.profile;
    const double angle = std::atan2(double{emission.x_axis.y}, double{emission.x_axis.x});
    return {profile.luminaire, profile.spread, angle * (180 / std::numbers::pi), profile.honeycomb};
}

} // namespace

LightProfile profile_of(const Scene& scene, const EditableLight& light) {
    for (const PolygonLight& polygon : light.parts.of<PolygonLight>())
        if (polygon.profile >= 0) return profile_in(scene, polygon.profile);
    for (const LineLight& line : light.parts.of<LineLight>())
        if (line.profile >= 0) return profile_in(scene, line.profile);
    for (const PointLight& point : light.parts.of<PointLight>())
        if (point.distribution == PointDistribution::profile)
            return {scene.luminaires[static_cast<std::size_t>(point.profile)]};
    return {};
}

std::optional<FieldDefect> change_profile(const GivenProfile& given, Scene& scene, EditableLight& light) {
    if (given.is_empty()) return std::nullopt;
    const LightProfile before = profile_of(scene, light);
    const ProfileRequest request = requested(given, before);
    if (is_same(request.luminaire, before.luminaire) && !given.angle && request.spread == before.spread &&
        request.honeycomb == before.honeycomb)
        return std::nullopt;
    if (const auto defect = find_defect(given, light)) return defect;
    if (!has_effect(request) && !has_effect(before))
        return FieldDefect{"ies_degrees", "it has no profile that could be turned"};
    if (!has_effect(request)) {
        for (LineLight& line : light.parts.of<LineLight>()) {
            line.profile = -1;
            if (line.model != TubeModel::strip) line.normal = {0, 0, 0};
        }
        for (PolygonLight& polygon : light.parts.of<PolygonLight>()) polygon.profile = -1;
        return std::nullopt;
    }
    const EmissionRule rule = given.luminaire != nullptr ? as_measured : keep;
    for (PointLight& point : light.parts.of<PointLight>()) fit(request, rule, kDown, scene, point);
    for (LineLight& line : light.parts.of<LineLight>()) fit(request, rule, kDown, scene, line);
    if (!fit(request, rule, scene, light.parts.of<PolygonLight>()))
        return FieldDefect{"ies", "a light with more than " + std::to_string(kMostLuminousFaces) +
                                      " normals cannot have a profile"};
    return std::nullopt;
}

void refit_profile(Scene& scene, EditableLight& light) {
    const LightProfile profile = profile_of(scene, light);
    if (has_effect(profile)) fit(profile, keep, scene, light.parts.of<PolygonLight>());
}

KeptProfile::KeptProfile(const Scene& scene, const EditableLight& light)
    : profile_(profile_of(scene, light)) {
    if (!has_effect(profile_)) return;
    Float3 emission = {0, 0, 0};
    double measured = 0;
    const auto place = [&](const auto& part) {
        axis_ = place_profile(part, scene.emission_profiles[static_cast<std::size_t>(part.profile)]).z_axis;
        emission = part.radiance;
    };
    if (const auto& polygons = light.parts.of<PolygonLight>(); !polygons.empty()) {
        place(polygons.front());
        if (const auto shape = profile_shape(polygons, 0, profile_); shape && !shape->radiance.empty())
            measured = shape->radiance.front();
    } else if (const auto& lines = light.parts.of<LineLight>(); !lines.empty()) {
        place(lines.front());
        const ProfiledShape shape = profile_line(lines.front(), profile_);
        if (!shape.radiance.empty()) measured = shape.radiance.front();
    } else {
        const PointLight& point = light.parts.of<PointLight>().front();
        axis_ = to_double(point.z_axis);
        emission = point.intensity;
        measured = measured_intensity(*profile_.luminaire);
    }
    if (measured > 0) factor_ = (1 / measured) * to_double(emission);
}

void KeptProfile::give_to(Scene& scene, EditableLight& light) const {
    if (!has_effect(profile_)) return;
    const EmissionRule rule = [&](const Float3& /*before*/, double measured) {
        return to_float(measured * factor_);
    };
    LightProfile without_holes = profile_;
    without_holes.honeycomb = {};
    if (has_effect(without_holes))
        for (LineLight& line : light.parts.of<LineLight>()) fit(without_holes, rule, axis_, scene, line);
    if (profile_.luminaire != nullptr)
        for (PointLight& point : light.parts.of<PointLight>()) fit(profile_, rule, axis_, scene, point);
    fit(profile_, rule, scene, light.parts.of<PolygonLight>());
}

} // namespace nusselt::scene
