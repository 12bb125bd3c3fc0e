#pragma once
/// Profiles of lights that rigs change.

#include "scene/model/profiles/emission_profile.h"
#include "scene/rig/light_edit.h"
#include "scene/rig/rig.h"

#include <optional>
#include <string>

namespace nusselt::scene {

/// What a light has of a profile; those of its parts are alike. The angle is that from the first edge of polygons, or from the line.
using LightProfile = ProfileRequest;
LightProfile profile_of(const Scene& scene, const EditableLight& light);

/// Gives a light a profile. With a luminaire, it gets the intensities that were measured, in its old colour. Nothing changes
/// if the light has this profile already.
/// \returns what does not fit the light; nothing if all is well
std::optional<FieldDefect> change_profile(const GivenProfile& profile, Scene& scene, EditableLight& light);

/// Fits the profile of polygons again whose sides have changed. They keep their radiance.
void refit_profile(Scene& scene, EditableLight& light);

/// A profile that outlives the shape of its light.
class KeptProfile {
public:
    KeptProfile(const Scene& scene, const EditableLight& light);
    /// Gives the profile to the new shape, as far as lights of its kind have one. With a luminaire, the light has the intensities
    /// that were measured, times the factor and in the colour that it had before.
    void give_to(Scene& scene, EditableLight& light) const;

private:
    LightProfile profile_;
    Double3 axis_ = {0, -1, 0};  ///< of the profile, in world space
    Double3 factor_ = {1, 1, 1}; ///< of what was measured, per channel
};

} // namespace nusselt::scene
