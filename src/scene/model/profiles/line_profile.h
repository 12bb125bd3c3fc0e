#pragma once
/// Profiles of tubes and lines.

#include "scene/model/lights/line_light.h"
#include "scene/model/profiles/emission_profile.h"

#include <array>

namespace nusselt::scene {

/// The profile of a tube, a linear light or a strip. Its axis is LineLight::normal, and its half-plane of 0 degrees contains the
/// line, from start to end, if the angle of the request is 0. The radiance is the intensity over the area that is visible, and
/// the spread acts around the normal of each point of the surface. Honeycombs are ignored.
/// \param light with a normal
ProfiledShape profile_line(const LineLight& light, const ProfileRequest& request);

/// What a spread lets pass of the light of a lateral surface: the mean over the surface, weighted by the area that a direction
/// sees. By the cotangent of the angle between direction and axis over the slope of the spread, in equal steps from 0 to 1, from
/// where on it is 0.
using TubeSpread = std::array<float, 65>;
/// \param slope see spread_slope()
TubeSpread tube_spread(double slope);
/// Interpolates between its numbers. \param cotangent over the slope, not negative
double passed_share_of_tube(const TubeSpread& table, double cotangent);

/// The part of a vector that is perpendicular to the line, of unit length; any such vector if both are parallel.
Float3 perpendicular_to_line(const LineLight& light, const Double3& vector);

} // namespace nusselt::scene
