#pragma once
/// Radiance of polygons, tubes and lines that depends on the direction, and is the same at each of their points but for the
/// spread of tubes, which acts around their normals.

#include "scene/model/float3.h"

#include <memory>

namespace nusselt::scene {

struct EmissionProfile;
struct LineLight;
struct PolygonLight;

/// The profile of one light. In a direction w, the light has the radiance `radiance` * f(w) / mean, with the function f of the
/// profile. So it emits as much as with its member `radiance` in all directions.
struct ProfiledEmission {
    std::shared_ptr<const EmissionProfile> profile;
    /// The axes of the profile, orthonormal, in the frame of the light. Of polygons: the first edge, the normal times that, and
    /// the normal of the side that emits. Of tubes and lines: the line, LineLight::normal times that, and this normal.
    Float3 x_axis = {1, 0, 0};
    Float3 z_axis = {0, 0, 1};
    float mean = 1; ///< of f, over projected solid angle and all that emits; 0 if the light is dark
};

/// Axes in world space: those of the profile, whose frame is right-handed, and the normal of the light.
struct ProfilePlacement {
    Double3 x_axis, y_axis, z_axis, normal;
};
ProfilePlacement place_profile(const PolygonLight& light, const ProfiledEmission& emission);
ProfilePlacement place_profile(const LineLight& light, const ProfiledEmission& emission);

} // namespace nusselt::scene
