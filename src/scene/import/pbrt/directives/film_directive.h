#pragma once
/// pbrt's film and pixel filter directives.

#include "scene/import/pbrt/syntax/parameters.h"

namespace nusselt::scene {

/// Defaults are 640x480 for pbrt v3's film "image", 1280x720 for those of v4. Throws SceneError if sizes are out of
/// range or no pixel is left.
Film read_film(std::string_view type, ParameterList& parameters, Warnings& warnings);

/// Radii have the names and defaults of `version`, or those of the other one where they are given by its names. A
/// filter that is not supported is replaced with a warning. Throws SceneError if the values define no filter.
PixelFilter read_pixel_filter(std::string_view type, ParameterList& parameters, PbrtVersion version,
                              Warnings& warnings);

} // namespace nusselt::scene
