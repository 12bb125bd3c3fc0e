#include "lab/errors/image_agreement.h"

#include "image/metrics.h"
#include "render_cpu/renderer.h"
#include "render_vulkan/renderer.h"

namespace nusselt::lab {

double differing_share(const image::Image& a, const image::Image& b) {
    return image::differing_share(a, b, kRelativeTolerance, kDarkest);
}

std::vector<render::RenderSettings> compared_settings() {
    std::vector<render::RenderSettings> all;
    for (const render::Technique technique : render::kTechniques) {
        render::RenderSettings& settings = all.emplace_back();
        settings.technique = technique;
        settings.pixel_position = render::PixelPosition::center;
        settings.samples = 2;
        // Renderers choose texels in different ways, with the same result on average.
        settings.emission_sampling = render::EmissionSampling::measure;
    }
    render::RenderSettings& both = all.emplace_back(all.front());
    both.technique = render::Technique::projected_solid_angle;
    both.strategies = render::Strategies::diffuse_ltc;
    return all;
}

std::vector<ImageAgreement> compare_with_cpu(const gpu::Device& device, const scene::Scene& scene,
                                             std::span<const render_vulkan::ShadowRays> ways,
                                             std::span<const render::RenderSettings> settings) {
    const render_cpu::Renderer cpu(scene, render_cpu::default_thread_count());
    std::vector<image::Image> references;
    for (const render::RenderSettings& one : settings)
        references.push_back(cpu.render(one, base::choose_isa()).image);
    std::vector<ImageAgreement> rows;
    for (const render_vulkan::ShadowRays way : ways) {
        render_vulkan::VulkanRenderer gpu(device, scene, way);
        for (std::size_t i = 0; i < settings.size(); ++i) {
            const render::RenderResult result = gpu.render(settings[i]);
            rows.push_back({way, settings[i], differing_share(result.image, references[i]),
                            result.statistics.rejected_samples});
        }
    }
    return rows;
}

} // namespace nusselt::lab
