#pragma once
/// Reads the images that lights emit.

#include "scene/build/textures/texture_image.h"
#include "scene/model/lights/textured_emission.h"

#include <filesystem>
#include <map>
#include <memory>

namespace nusselt::scene {

/// The images that lights of one scene emit. Each file is decoded once.
class EmissionImages {
public:
    /// Throws SceneError at the location of the request if the image cannot be read, or is too large.
    std::shared_ptr<const EmissionTexture> read(const ImageRequest& request, SceneBudget& budget,
                                                Warnings& warnings);

private:
    std::map<std::filesystem::path, std::shared_ptr<const EmissionTexture>> images_;
};

/// The mean of all texels.
Float3 mean_texel(const EmissionTexture& texture);
/// The largest number of each channel.
Float3 largest_texel(const EmissionTexture& texture);

} // namespace nusselt::scene
