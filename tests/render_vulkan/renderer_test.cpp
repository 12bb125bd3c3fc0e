/// The behaviour of the renderer apart from the image.

#include "common/process_memory.h"
#include "comparison.h"
#include "gpu_test.h"
#include "rich_scene.h"
#include "scenes.h"

#include <atomic>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <unistd.h>

namespace nusselt::render_vulkan_test {
namespace {

using render_vulkan::ShadowRays;
using render_vulkan::VulkanRenderer;

class Renderer : public parity::GpuTest {};

/// Memory of this process, which is also that of a software device [bytes].
std::size_t resident_bytes() {
    std::size_t all = 0;
    std::size_t resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST_F(Renderer, GivesTheSameImageAgain) {
    const scene::Scene scene = make_rich_scene(32, 24);
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    render::RenderSettings settings;
    settings.samples = 4;
    const auto first = renderer.render(settings);
    EXPECT_GT(first.statistics.shadow_rays, 0u);
    EXPECT_EQ(first.statistics.primary_rays, 4u * 32 * 24);
    const auto second = renderer.render(settings);
    EXPECT_EQ(first.image.pixels, second.image.pixels);
    EXPECT_EQ(first.statistics.shadow_rays, second.statistics.shadow_rays);
}

TEST_F(Renderer, TakesNoMoreMemoryOverFrames) {
    const scene::Scene scene = make_rich_scene(32, 24);
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    render::RenderSettings settings;
    settings.samples = 64;
    static_cast<void>(renderer.render(settings));
    const std::size_t before = resident_bytes();
    settings.samples = 1024;
    static_cast<void>(renderer.render(settings));
    EXPECT_LT(resident_bytes(), before + (std::size_t{4} << 20));
}

TEST_F(Renderer, ScalesSumsByFramesThatWereFinished) {
    scene::Scene scene = render_test::make_floor(8);
    render_test::add_polygon_light(scene, {scene::Float3{-9, -9, 5}, {-9, 9, 5}, {9, 9, 5}, {9, -9, 5}},
                                   {1, 1, 1}, true, 0);
    render_test::set_radius(scene);
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    render::RenderSettings settings;
    settings.samples = 8;
    std::atomic<bool> stop = false;
    render::RenderMonitor monitor;
    monitor.cancel = &stop;
    monitor.progress = [&](double fraction) { stop = fraction >= 0.25; };
    const auto part = renderer.render(settings, monitor);
    EXPECT_EQ(part.finished_fraction, 0.25);
    const auto whole = renderer.render(settings);
    const auto mean = [](const image::Image& image) {
        double sum = 0;
        for (const float value : image.pixels) sum += value;
        return sum / static_cast<double>(image.pixels.size());
    };
    EXPECT_NEAR(mean(part.image) / mean(whole.image), 1, 0.05);
    EXPECT_GT(mean(whole.image), 0);
}

/// Renders so many of all frames. \param share of them
image::Image rendered_until(VulkanRenderer& renderer, const render::RenderSettings& settings, double share) {
    std::atomic<bool> stop = share == 0;
    render::RenderMonitor monitor;
    monitor.cancel = &stop;
    monitor.progress = [&](double fraction) { stop = fraction >= share; };
    const auto result = renderer.render(settings, monitor);
    EXPECT_EQ(result.finished_fraction, share);
    return result.image;
}

TEST_F(Renderer, StopsWithinFramesAndKeepsTheFramesBefore) {
    scene::Scene scene = render_test::make_floor(96);
    render_test::set_camera(scene, {0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 0.3, 96, 96);
    render_test::add_polygon_light(scene, {scene::Float3{-9, -9, 5}, {-9, 9, 5}, {9, 9, 5}, {9, -9, 5}},
                                   {1, 1, 1}, true, 0);
    render_test::set_radius(scene);
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    // Frames of several submissions: some are fast enough for a few of them, others take minutes on software devices.
    for (const int samples_per_ray : {64, 1 << 14}) {
        render::RenderSettings settings;
        settings.camera_rays = 64;
        settings.samples = 64 * samples_per_ray;
        static_cast<void>(rendered_until(renderer, settings, 0)); // compiles the shaders
        for (const double delay : {0.05, 0.4, 0.7}) {
            std::atomic<bool> stop = false;
            render::RenderMonitor monitor;
            monitor.cancel = &stop;
            std::chrono::steady_clock::time_point request;
            std::thread thread([&] {
                std::this_thread::sleep_for(std::chrono::duration<double>(delay));
                request = std::chrono::steady_clock::now();
                stop = true;
            });
            const render::RenderResult result = renderer.render(settings, monitor);
            const auto end = std::chrono::steady_clock::now();
            thread.join();
            if (samples_per_ray > 64) {
                EXPECT_LT(result.finished_fraction, 1) << "nothing was stopped";
            }
            EXPECT_LT(std::chrono::duration<double>(end - request).count(), 1);
            EXPECT_EQ(result.image.pixels,
                      rendered_until(renderer, settings, result.finished_fraction).pixels);
        }
    }
}

TEST_F(Renderer, StopsWithinFramesOfMillionsOfSubmissions) {
    scene::Scene scene = render_test::make_floor(8);
    for (int i = 0; i < 500; ++i)
        render_test::add_polygon_light(scene, {scene::Float3{-9, -9, 5}, {-9, 9, 5}, {9, 9, 5}, {9, -9, 5}},
                                       {1, 1, 1}, true, 0);
    render_test::set_radius(scene);
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    render::RenderSettings settings;
    settings.camera_rays = 1;
    settings.samples = 1 << 20;
    static_cast<void>(rendered_until(renderer, settings, 0)); // compiles the shaders
    const double memory_before = nusselt_test::process_memory("VmHWM");
    std::atomic<bool> stop = false;
    render::RenderMonitor monitor;
    monitor.cancel = &stop;
    std::chrono::steady_clock::time_point request;
    std::thread thread([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        request = std::chrono::steady_clock::now();
        stop = true;
    });
    EXPECT_EQ(renderer.render(settings, monitor).finished_fraction, 0);
    const auto end = std::chrono::steady_clock::now();
    thread.join();
    EXPECT_LT(std::chrono::duration<double>(end - request).count(), 1);
    EXPECT_LT(nusselt_test::process_memory("VmHWM"), memory_before + 64e6) << "no list of all submissions";
}

TEST_F(Renderer, RendersScenesWithoutAnything) {
    scene::Scene empty;
    empty.film.width = empty.film.height = 8;
    const auto result = VulkanRenderer(device(), empty, ShadowRays::bvh).render({});
    for (const float value : result.image.pixels) EXPECT_EQ(value, 0);
    scene::Scene unlit = render_test::make_floor(8);
    render_test::set_radius(unlit);
    for (const float value : VulkanRenderer(device(), unlit, ShadowRays::bvh).render({}).image.pixels)
        EXPECT_EQ(value, 0);
}

TEST_F(Renderer, RefusesSettingsOfTheCpuAlone) {
    const scene::Scene scene = make_rich_scene(8, 8);
    VulkanRenderer renderer(device(), scene, ShadowRays::bvh);
    render::RenderSettings lines;
    lines.light_samples = render::LightSamples::lines;
    EXPECT_THROW(static_cast<void>(renderer.render(lines)), std::invalid_argument);
    render::RenderSettings layers;
    layers.layers = {render::LayerKind::normal};
    EXPECT_THROW(static_cast<void>(renderer.render(layers)), std::invalid_argument);
    render::RenderSettings part;
    part.part = {1, 2};
    EXPECT_THROW(static_cast<void>(renderer.render(part)), std::invalid_argument);
}

TEST_F(Renderer, NamesRayQueriesThatTheDeviceDoesNotHave) {
    if (device().features().ray_queries) GTEST_SKIP() << "the device has them";
    const scene::Scene scene = make_rich_scene(8, 8);
    try {
        VulkanRenderer(device(), scene, ShadowRays::query);
        FAIL() << "no error";
    } catch (const gpu::Error& error) {
        EXPECT_EQ(error.what(), device().description().name +
                                    ": the device does not support ray queries; use --shadow-rays bvh");
    }
}

} // namespace
} // namespace nusselt::render_vulkan_test
