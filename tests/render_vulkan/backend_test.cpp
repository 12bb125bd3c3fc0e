/// A GPU as a backend.

#include "backend_contract.h"
#include "comparison.h"
#include "gpu_test.h"
#include "rich_scene.h"
#include "scenes.h"

#include "render_cpu/backend.h"
#include "render_vulkan/backend.h"

#include <optional>
#include <stdexcept>
#include <string>

namespace nusselt::render_vulkan_test {
namespace {

using render_vulkan::ShadowRays;
using render_vulkan::VulkanBackend;

class GpuBackend : public parity::GpuTest {
protected:
    /// Created at the first call. Its device keeps the shaders, whose compilation takes longer than the tests.
    static const VulkanBackend& backend() {
        if (!backend_)
            backend_.emplace(gpu::DeviceOptions{.validation = gpu::Validation::on}, ShadowRays::bvh);
        return *backend_;
    }
    static void TearDownTestSuite() { backend_.reset(); }

    static scene::Scene lit_floor() {
        scene::Scene scene = render_test::make_floor(40);
        render_test::set_camera(scene, {0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 0.3, 40, 40);
        render_test::add_polygon_light(scene, {scene::Float3{-9, -9, 5}, {-9, 9, 5}, {9, 9, 5}, {9, -9, 5}},
                                       {1, 1, 1}, true, 0);
        render_test::set_radius(scene);
        return scene;
    }

private:
    static inline std::optional<VulkanBackend> backend_;
};

TEST_F(GpuBackend, FulfilsTheContract) { render_test::expect_backend_contract(backend(), lit_floor(), {}); }

TEST_F(GpuBackend, RendersWhatTheCpuRenders) {
    const scene::Scene scene = lit_floor();
    const VulkanBackend& gpu = backend();
    const render_cpu::CpuBackend cpu(base::choose_isa(), 2);
    EXPECT_NE(gpu.name(), cpu.name());
    const image::Image on_gpu = render::render(gpu, scene, {}).image;
    EXPECT_LE(differing_share(on_gpu, render::render(cpu, scene, {}).image), 0.01);
}

TEST_F(GpuBackend, NamesSettingsThatItDoesNotSupport) {
    render::RenderSettings lines;
    lines.light_samples = render::LightSamples::lines;
    EXPECT_EQ(backend().why_unsupported(lines), "--light-samples lines is not supported on GPUs");
    render::RenderSettings layers;
    layers.layers = {render::LayerKind::normal};
    EXPECT_EQ(backend().why_unsupported(layers), "layer normal is not supported on GPUs");
    render::RenderSettings part;
    part.part = {1, 2};
    EXPECT_EQ(backend().why_unsupported(part), "--part is not supported on GPUs");
    EXPECT_THROW(static_cast<void>(render::render(backend(), lit_floor(), part)), std::invalid_argument);
}

TEST_F(GpuBackend, KnowsTheShareOfAStoppedFrame) {
    const scene::Scene scene = lit_floor();
    render::RenderSettings settings;
    settings.samples = 4;
    std::atomic<bool> cancel = false;
    render::RenderMonitor monitor;
    monitor.cancel = &cancel;
    monitor.progress = [&](double) { cancel = true; };
    render::Frame frame = render::make_frame(scene, settings);
    backend().prepare(scene)->render_into(frame, settings, monitor);
    EXPECT_EQ(finished_fraction(frame), 0.25);
}

} // namespace
} // namespace nusselt::render_vulkan_test
