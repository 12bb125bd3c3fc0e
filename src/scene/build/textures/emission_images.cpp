#include "scene/build/textures/emission_images.h"

#include "scene/model/vector_math.h"

#include <string>
#include <utility>

namespace nusselt::scene {

namespace {

EmissionTexture take_texels(Texture texture) {
    EmissionTexture result;
    result.name = std::move(texture.name);
    result.path = std::move(texture.path);
    result.width = texture.width;
    result.height = texture.height;
    const auto channels = static_cast<std::size_t>(texture.channels);
    const std::size_t green = channels > 1 ? 1 : 0;
    result.texels.reserve(texture.texels.size() / channels);
    for (std::size_t i = 0; i + channels <= texture.texels.size(); i += channels)
        result.texels.push_back(
            {texture.texels[i], texture.texels[i + green], texture.texels[i + 2 * green]});
    return result;
}

} // namespace

std::shared_ptr<const EmissionTexture> EmissionImages::read(const ImageRequest& request, SceneBudget& budget,
                                                            Warnings& warnings) {
    std::shared_ptr<const EmissionTexture>& image = images_[request.path];
    if (image != nullptr) return image;
    Texture texture = decode_image(request, budget, warnings);
    if (texture.width > kMaxEmissionTextureSize || texture.height > kMaxEmissionTextureSize)
        throw SceneError(request.location,
                         "texture file '" + request.path.string() + "': images of lights must have at most " +
                             std::to_string(kMaxEmissionTextureSize) + " pixels per side, found " +
                             std::to_string(texture.width) + " x " + std::to_string(texture.height));
    image = std::make_shared<const EmissionTexture>(take_texels(std::move(texture)));
    return image;
}

Float3 mean_texel(const EmissionTexture& texture) {
    Double3 sum;
    for (const Float3& texel : texture.texels) sum = sum + to_double(texel);
    return to_float((1 / static_cast<double>(texture.texels.size())) * sum);
}

Float3 largest_texel(const EmissionTexture& texture) {
    Float3 largest = {0, 0, 0};
    for (const Float3& texel : texture.texels) largest = per_channel_maximum(largest, texel);
    return largest;
}

} // namespace nusselt::scene
