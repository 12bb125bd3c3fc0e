#pragma once
/// The emission of shapes.

#include "scene/input/diagnostics.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/scene.h"

#include <memory>
#include <optional>
#include <string_view>

namespace nusselt::scene {

struct Emission {
    Float3 radiance = {
        0, 0, 0}; ///< of a texel of 1 if there is a texture; to be scaled to `power`, if there is one
    bool two_sided = false;
    /// The total power of each shape if the luminance of `radiance` were one [W]. With a texture, the total power whatever the
    /// brightness of the texture.
    std::optional<double> power = {};
    std::shared_ptr<const EmissionTexture> texture = {}; ///< null for uniform radiance
    /// How the radiance depends on the direction, null if it does not; not together with a texture. With a luminaire and
    /// without `power`, `radiance` is a factor of what was measured, for each channel. Most emissions have none.
    std::shared_ptr<const ProfileRequest> profile = {};
};

/// Throws SceneError at `location` unless all channels of an emission are from 0 to kMaxRadiance.
/// \param subject  what the format calls the light
void check_emission(const Float3& value, const EmissionQuantity& quantity, std::string_view subject,
                    const Location& location);

/// The same for a radiance.
/// \param subject  what the format calls the emission
void check_radiance(const Float3& radiance, std::string_view subject, const Location& location);

/// The radiance in each channel where a texel is largest [W/(sr m^2)]: what must not exceed kMaxRadiance once all is scaled.
/// \param radiance       of the light, for the mean of its texels
/// \param mean, largest  of the texels
Float3 brightest_radiance(const Float3& radiance, const Float3& mean, const Float3& largest);

/// The radiance of a shape of this area [m^2], which counts one side even if both emit. Throws SceneError at
/// `location` if the radiance is above kMaxRadiance.
/// \param area     with a texture, times the mean luminance of its texels
/// \param subject  what the format calls the emission
Float3 radiance_of(const Emission& emission, double area, std::string_view subject, const Location& location);

/// The same emission with the mean of the texture everywhere.
Emission without_texture(const Emission& emission);

} // namespace nusselt::scene
