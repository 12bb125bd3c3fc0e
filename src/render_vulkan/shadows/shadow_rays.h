#pragma once
/// The ways in which GPUs trace shadow rays, for programs with and without GPU support.

#include <array>
#include <string_view>

namespace nusselt::render_vulkan {

/// How shadow rays are traced.
enum class ShadowRays {
    query, ///< by the device, with VK_KHR_ray_query
    bvh,   ///< by shaders, in a hierarchy of their own
    none,  ///< not at all, to measure the cost of everything else
};

inline constexpr std::array kShadowRays = {ShadowRays::query, ShadowRays::bvh, ShadowRays::none};

constexpr std::string_view name_of(ShadowRays way) {
    switch (way) {
    case ShadowRays::query:
        return "query";
    case ShadowRays::bvh:
        return "bvh";
    case ShadowRays::none:
        break;
    }
    return "none";
}

} // namespace nusselt::render_vulkan
