#pragma once
/// The emission of shapes.

#include "scene/input/diagnostics.h"
#include "scene/model/scene.h"

#include <optional>
#include <string_view>

namespace nusselt::scene {

struct Emission {
    Float3 radiance = {0, 0, 0}; ///< to be scaled to `power`, if there is one
    bool two_sided = false;
    /// The total power of each shape if the luminance of `radiance` were one [W].
    std::optional<double> power;
};

/// Throws SceneError at `location` unless all channels of an emission are from 0 to kMaxRadiance.
/// \param subject  what the format calls the light
void check_emission(const Float3& value, const EmissionQuantity& quantity, std::string_view subject,
                    const Location& location);

/// The same for a radiance.
/// \param subject  what the format calls the emission
void check_radiance(const Float3& radiance, std::string_view subject, const Location& location);

/// The radiance of a shape of this area [m^2], which counts one side even if both emit. Throws SceneError at
/// `location` if the radiance is above kMaxRadiance.
/// \param subject  what the format calls the emission
Float3 radiance_of(const Emission& emission, double area, std::string_view subject, const Location& location);

} // namespace nusselt::scene
