#include "scene/model/lights/distant_light.h"

#include "scene/model/content_hash.h"
#include "scene/model/lights/light_geometry.h"
#include "scene/model/lights/light_text.h"
#include "scene/model/number_text.h"
#include "scene/model/transform.h"

#include <limits>
#include <numbers>

namespace nusselt::scene {

namespace {

using Kind = LightKind<DistantLight>;

} // namespace

// A new member does not compile until it is listed here.
void Kind::hash(const DistantLight& light, ContentHash& hash) {
    const auto& [emitter, direction, irradiance] = light;
    hash.add(emitter, direction, irradiance);
}

Double3 Kind::flux_per_emission(const DistantLight& /*light*/, double scene_radius) {
    const double area = std::numbers::pi * scene_radius * scene_radius;
    return {area, area, area};
}

void Kind::add_moment(const DistantLight& /*light*/, Moment& moment) { moment.add(1, {}); }

bool Kind::is_valid(const DistantLight& light) {
    return is_valid_coordinate(light.direction) && !is_black(light.direction);
}

void Kind::transform(DistantLight& light, const Transform& transform) {
    light.direction = to_float(normalized(transform_vector(transform, to_double(light.direction))));
}

/// Directions agree up to the rounding of files.
bool Kind::same_shape(const DistantLight& a, const DistantLight& b) {
    constexpr double kRounding = 1e-6;
    return length(to_double(a.direction) - to_double(b.direction)) <= kRounding;
}

/// Nobody can point at it.
double Kind::hit(const DistantLight& /*light*/, const SightRay& /*ray*/) {
    return std::numeric_limits<double>::infinity();
}

std::string Kind::describe(std::span<const DistantLight> lights, double scene_radius) {
    const DistantLight& first = lights.front();
    const auto count = static_cast<double>(lights.size());
    return "direction " + report_text(first.direction) + ", irradiance " + report_text(first.irradiance) +
           " W/m^2, " + power_text(count * flux_per_emission(first, scene_radius), first.irradiance) +
           " into the radius of the scene";
}

std::string Kind::rig_field(const DistantLight& light) {
    return "\"distant\": " + triple_text(light.direction);
}

} // namespace nusselt::scene
