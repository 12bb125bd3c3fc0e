#include "scene/build/textures/texture_plan.h"

namespace nusselt::scene {

int TexturePlanner::image(ImageRequest request) {
    request.path = request.path.lexically_normal();
    const auto [entry, is_new] =
        image_numbers_.try_emplace({request.path, request.encoding}, static_cast<int>(images_.size()));
    if (is_new) images_.push_back(std::move(request));
    return entry->second;
}

int TexturePlanner::request(const TextureValue& value, int channels, const Location& location) {
    if (value.node < 0) return -1;
    const auto [entry, is_new] =
        request_numbers_.try_emplace({value.node, channels}, static_cast<int>(requests_.size()));
    if (is_new) requests_.push_back({value.node, channels, location});
    return entry->second;
}

} // namespace nusselt::scene
