#pragma once
/// Replaces images that lights emit by their mean colours.

#include "scene/build/textures/texture_image.h"

#include <filesystem>
#include <map>

namespace nusselt::scene {

/// The mean colours of images that lights emit. Each image is decoded once.
class EmissionImages {
public:
    /// Throws SceneError at the location of the request if the image cannot be read.
    Float3 mean_colour(const ImageRequest& request, SceneBudget& budget, Warnings& warnings);

private:
    std::map<std::filesystem::path, Float3> mean_colours_;
};

} // namespace nusselt::scene
