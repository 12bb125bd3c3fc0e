#pragma once
/// Profiles of lights that rigs change.

#include "scene/model/profiles/emission_profile.h"
#include "scene/rig/light_edit.h"
#include "scene/rig/rig.h"

#include <optional>
#include <string>

namespace nusselt::scene {

/// What a light has of a profile; those of its parts are alike.
struct LightProfile {
    std::shared_ptr<const Luminaire> luminaire; ///< null for none
    double spread = kWidestSpread;              ///< [degrees]
    double angle = 0;                           ///< ProfileRequest::angle from the first edge of polygons
};
LightProfile profile_of(const Scene& scene, const EditableLight& light);

/// Gives a light a profile. With a luminaire, it gets the intensities that were measured, in its old colour. Nothing changes
/// if the light has this profile already.
/// \returns what does not fit the light, as the field and a message; nothing if all is well
struct ProfileDefect {
    std::string field, message;
};
std::optional<ProfileDefect> change_profile(const GivenProfile& profile, Scene& scene, EditableLight& light);

/// Fits the profile of polygons again whose sides have changed. They keep their radiance.
void refit_profile(Scene& scene, EditableLight& light);

} // namespace nusselt::scene
