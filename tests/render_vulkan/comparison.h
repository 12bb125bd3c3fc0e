#pragma once
/// The same image by both renderers.

#include "lab/errors/image_agreement.h"
#include "render_cpu/renderer.h"
#include "render_vulkan/renderer.h"

namespace nusselt::render_vulkan_test {

using lab::differing_share;

inline image::Image render_on_cpu(const scene::Scene& scene, const render::RenderSettings& settings) {
    return render_cpu::Renderer(scene, 2).render(settings, base::choose_isa()).image;
}

} // namespace nusselt::render_vulkan_test
