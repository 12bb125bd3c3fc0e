#pragma once
/// AreaLightSource directives.

#include "scene/build/lights/emission.h"
#include "scene/build/textures/emission_images.h"
#include "scene/import/pbrt/syntax/parameters.h"

#include <filesystem>
#include <string>

namespace nusselt::scene {

/// Reduces an AreaLightSource directive; docs/materials.md has the rules. Unknown types do not emit, with a warning.
/// \param image_path  of the file that the parameter "filename" names; unused if there is none
/// Throws SceneError at values that are negative or not finite, and if the image cannot be read.
Emission read_emission(const std::string& type, ParameterList& parameters,
                       const std::filesystem::path& image_path, EmissionImages& images, Warnings& warnings);

} // namespace nusselt::scene
