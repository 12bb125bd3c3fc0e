#pragma once
/// The formulas and images of the textures of a scene, and the requests for them.

#include "scene/build/textures/texture_formula.h"
#include "scene/build/textures/texture_image.h"

#include <filesystem>
#include <map>
#include <utility>
#include <vector>

namespace nusselt::scene {

/// A texture that a material requests.
struct TextureRequest {
    int node = -1;
    int channels = 3;  ///< 3, or 1 for the mean of the channels
    Location location; ///< of the material
};

/// The images and formulas from which the textures of a scene are made.
struct TexturePlan {
    std::vector<ImageRequest> images;
    std::vector<TextureNode> nodes;
    std::vector<TextureRequest> requests;
};

/// The images that the requests need, in their order.
std::vector<ImageRequest> needed_images(const TexturePlan& plan);

/// Collects the images, formulas and requests of an importer. Equal ones are planned once.
class TexturePlanner {
public:
    TextureFormulas& formulas() { return formulas_; }
    /// The index of an image, for TextureNode::image.
    int image(ImageRequest request);
    /// Requests the node of a value as a texture.
    /// \param channels  3 or 1
    /// \returns the index of the request; -1 for values without a node
    int request(const TextureValue& value, int channels, const Location& location);
    /// All requests so far.
    TexturePlan plan() const { return {images_, formulas_.nodes(), requests_}; }

private:
    std::vector<ImageRequest> images_;
    std::map<std::pair<std::filesystem::path, ImageRequest::Encoding>, int> image_numbers_;
    std::vector<TextureRequest> requests_;
    std::map<std::pair<int, int>, int> request_numbers_; ///< by node and number of channels
    TextureFormulas formulas_;
};

} // namespace nusselt::scene
