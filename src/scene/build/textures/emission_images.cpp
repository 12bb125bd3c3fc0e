#include "scene/build/textures/emission_images.h"

#include "scene/model/vector_math.h"

namespace nusselt::scene {

namespace {

Float3 mean_texel(const Texture& texture) {
    Double3 sum;
    const auto channels = static_cast<std::size_t>(texture.channels);
    const std::size_t green = channels > 1 ? 1 : 0;
    for (std::size_t i = 0; i + channels <= texture.texels.size(); i += channels)
        sum = sum + Double3{texture.texels[i], texture.texels[i + green], texture.texels[i + 2 * green]};
    return to_float((static_cast<double>(channels) / static_cast<double>(texture.texels.size())) * sum);
}

} // namespace

Float3 EmissionImages::mean_colour(const ImageRequest& request, SceneBudget& budget, Warnings& warnings) {
    const auto known = mean_colours_.find(request.path);
    if (known != mean_colours_.end()) return known->second;
    const Float3 mean = mean_texel(decode_image(request, budget, warnings));
    mean_colours_.emplace(request.path, mean);
    return mean;
}

} // namespace nusselt::scene
