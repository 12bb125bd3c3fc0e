#pragma once
/// A measured luminaire, of which several lights of a scene may be copies.

#include "scene/model/profiles/intensity_profile.h"

#include <memory>
#include <string>

namespace nusselt::scene {

struct Luminaire {
    std::string name; ///< of its file
    std::string path; ///< of its file, so that two mentions of one file are the same
    IntensityProfile profile;
};

} // namespace nusselt::scene
