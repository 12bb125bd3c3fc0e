#pragma once
/// Tests of lights whose radiance varies: the GPU renders the image of the CPU.

#include "comparison.h"
#include "gpu_test.h"

#include <gtest/gtest.h>

namespace nusselt::render_vulkan_test {

class EmissionTest : public parity::GpuTest {
protected:
    render_vulkan::VulkanRenderer renderer_of(const scene::Scene& scene) const {
        return {device(), scene, render_vulkan::default_shadow_rays(device())};
    }

    /// \param renderer of the scene
    /// \param mutant   another scene, whose image has to differ: the test of the test
    static void expect_agreement(render_vulkan::VulkanRenderer& renderer, const scene::Scene& scene,
                                 const scene::Scene& mutant, const render::RenderSettings& settings) {
        SCOPED_TRACE(testing::Message() << name_of(settings.technique) << ", " << name_of(settings.strategies)
                                        << ", " << name_of(settings.mis));
        const render::RenderResult result = renderer.render(settings);
        EXPECT_LT(differing_share(result.image, render_on_cpu(scene, settings)), lab::kLargestDifferingShare);
        EXPECT_EQ(result.statistics.rejected_samples, 0u);
        EXPECT_GT(differing_share(result.image, render_on_cpu(mutant, settings)),
                  2 * lab::kLargestDifferingShare);
    }
};

} // namespace nusselt::render_vulkan_test
