#include "scene/rig/rig_files.h"

#include "scene/build/lights/environment.h"

#include <optional>
#include <stdexcept>
#include <string>

namespace nusselt::scene {

RigFiles::RigFiles() = default;
RigFiles::~RigFiles() = default;

std::shared_ptr<const Luminaire> RigFiles::profile(const std::filesystem::path& path) {
    return luminaires_.read(path);
}

std::shared_ptr<const EmissionTexture> RigFiles::image(const std::filesystem::path& path) {
    Warnings warnings; // of texels that are no numbers, which become black
    return images_.read({path, ImageRequest::kSrgb, {}}, budget_, warnings);
}

std::shared_ptr<const EnvironmentMapTexels> RigFiles::map(const std::filesystem::path& path) {
    std::shared_ptr<const EnvironmentMapTexels>& map = maps_[path];
    if (map != nullptr) return map;
    Warnings warnings;
    const Texture image = decode_image({path, ImageRequest::kSrgb, {}}, budget_, warnings);
    const std::optional<EnvironmentImage> kind = image_kind(image);
    if (!kind)
        throw std::runtime_error("texture file '" + path.string() +
                                 "': maps must be square or twice as wide as high, found " +
                                 std::to_string(image.width) + " x " + std::to_string(image.height));
    map = std::make_shared<const EnvironmentMapTexels>(make_environment_map_texels(image, *kind));
    return map;
}

} // namespace nusselt::scene
