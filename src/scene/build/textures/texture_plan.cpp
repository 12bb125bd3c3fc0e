#include "scene/build/textures/texture_plan.h"

namespace nusselt::scene {

std::vector<ImageRequest> needed_images(const TexturePlan& plan) {
    std::vector<bool> is_needed(plan.nodes.size());
    for (const TextureRequest& request : plan.requests)
        is_needed[static_cast<std::size_t>(request.node)] = true;
    std::vector<bool> needs_image(plan.images.size());
    // Operands come before the nodes that have them.
    for (std::size_t i = plan.nodes.size(); i-- > 0;) {
        if (!is_needed[i]) continue;
        for (const int operand : plan.nodes[i].operands)
            if (operand >= 0) is_needed[static_cast<std::size_t>(operand)] = true;
        if (plan.nodes[i].image >= 0) needs_image[static_cast<std::size_t>(plan.nodes[i].image)] = true;
    }
    std::vector<ImageRequest> images;
    for (std::size_t i = 0; i < plan.images.size(); ++i)
        if (needs_image[i]) images.push_back(plan.images[i]);
    return images;
}

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
