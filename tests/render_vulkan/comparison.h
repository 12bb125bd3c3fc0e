#pragma once
/// The same image by both renderers.

#include "lab/errors/image_agreement.h"
#include "render_cpu/renderer.h"
#include "render_vulkan/renderer.h"

#include <algorithm>

namespace nusselt::render_vulkan_test {

using lab::differing_share;

inline image::Image render_on_cpu(const scene::Scene& scene, const render::RenderSettings& settings) {
    return render_cpu::Renderer(scene, 2).render(settings, base::choose_isa()).image;
}

/// Whether the renderer for GPUs has all lights of a scene.
inline bool is_supported(const scene::Scene& scene) {
    const auto& environments = scene.lights.of<scene::EnvironmentLight>();
    return std::all_of(environments.begin(), environments.end(),
                       [](const scene::EnvironmentLight& light) { return light.portal.size() == 0; });
}

} // namespace nusselt::render_vulkan_test
