#pragma once
/// AreaLightSource directives.

#include "scene/build/lights/emission.h"
#include "scene/build/textures/emission_images.h"
#include "scene/import/ies/luminaires.h"
#include "scene/import/pbrt/syntax/parameters.h"

#include <filesystem>
#include <string>

namespace nusselt::scene {

/// The files that the emissions of a scene name.
struct EmissionFiles {
    EmissionImages images;
    Luminaires luminaires;
};

/// The files that one directive names; unused if there is none.
struct EmissionPaths {
    std::filesystem::path image; ///< by the parameter "filename"
    std::filesystem::path ies;   ///< by the parameter "ies"
};

/// Reduces an AreaLightSource directive; docs/materials.md has the rules. Unknown types do not emit, with a warning.
/// Throws SceneError at values that are negative or not finite, and if a file cannot be read.
Emission read_emission(const std::string& type, ParameterList& parameters, const EmissionPaths& paths,
                       EmissionFiles& files, Warnings& warnings);

} // namespace nusselt::scene
