/// Settings that shaders have no code for are errors, not images.

#include "gpu_test.h"
#include "rich_scene.h"

#include "interface/settings.h"
#include "render_vulkan/accumulator.h"
#include "render_vulkan/frame_records.h"

#include <algorithm>
#include <string>
#include <vector>

namespace nusselt::render_vulkan_test {
namespace {

using render_vulkan::DeviceScene;
using render_vulkan::PixelBuffers;
using render_vulkan::ShadowRays;

constexpr std::uint32_t kSide = 16;

class UnknownSettings : public parity::GpuTest {
protected:
    /// Pixels that were shaded by a pipeline with these constants and had a setting that is unknown there.
    std::uint32_t unknown_count(const std::vector<std::uint32_t>& constants,
                                int mis = interface::kMisBalance) {
        PixelBuffers pixels(device(), kSide, kSide);
        const std::vector<std::uint32_t> first_triangle(kSide * kSide, 1);
        pixels.numbers.write(std::span<const std::uint32_t>(first_triangle));
        const render_vulkan::ShadingPass pass(scene(), constants, pixels);
        interface::FrameRecord frame = render_vulkan::FrameRecords(scene().film(), {}).make(0);
        frame.mis = mis;
        frame.light_end = scene().light_count();
        frame.sample_end = frame.light_samples;
        const gpu::Device::Record record = [&](const gpu::Device::Commands& commands) {
            pass.record(commands, frame, kSide);
        };
        static_cast<void>(device().time_passes(std::span(&record, 1)));
        interface::WorkRecord work {};
        pixels.work.read(std::span(&work, 1));
        EXPECT_EQ(work.unfinished, 0u);
        return work.unknown_settings;
    }

    const DeviceScene& scene() {
        if (!scene_) {
            // Lights share what is tested, and drivers take the longer for each kind of them.
            scene::Scene scene = make_plain_scene(kSide, kSide);
            scene.lights.of<scene::LineLight>().clear();
            scene_.emplace(device(), scene, ShadowRays::none);
        }
        return *scene_;
    }

    std::vector<std::uint32_t> known_constants() {
        // Those whose shaders drivers compile in the least time.
        render::RenderSettings settings;
        settings.technique = render::Technique::area;
        settings.brdf = render::BrdfChoice::lambert;
        return render_vulkan::shading_constants(settings, scene().kinds());
    }

private:
    std::optional<DeviceScene> scene_;
};

TEST_F(UnknownSettings, AreCountedByShaders) {
    EXPECT_EQ(unknown_count(known_constants()), 0u);
    EXPECT_EQ(unknown_count(known_constants(), interface::kMisCount), kSide * kSide);
    const std::pair<int, int> ends[] = {
        {interface::kTechniqueConstant, interface::kTechniqueCount},
        {interface::kStrategiesConstant, interface::kStrategiesCount},
        {interface::kSamplerConstant, interface::kSamplerCount},
        {interface::kBrdfConstant, interface::kBrdfCount},
        {interface::kEmissionSamplingConstant, interface::kEmissionSamplingCount}};
    for (const auto& [number, end] : ends) {
        std::vector<std::uint32_t> constants = known_constants();
        constants.at(static_cast<std::size_t>(number)) = static_cast<std::uint32_t>(end);
        EXPECT_EQ(unknown_count(constants), kSide * kSide) << number;
    }
}

std::string error_of(const interface::WorkRecord& work) {
    try {
        static_cast<void>(render_vulkan::checked_work(work, "a device"));
    } catch (const gpu::Error& error) {
        return error.what();
    }
    return "";
}

TEST(CheckedWork, ReportsWrongImages) {
    interface::WorkRecord work {};
    work.shadow_rays[0] = 5;
    work.shadow_rays[1] = 1;
    work.rejected_samples[0] = 3;
    const render_vulkan::FrameWork counted = render_vulkan::checked_work(work, "a device");
    EXPECT_EQ(counted.shadow_rays, (std::uint64_t{1} << 32) + 5);
    EXPECT_EQ(counted.rejected_samples, 3u);
    work.unknown_settings = 1;
    EXPECT_EQ(error_of(work), "a device: a setting is not supported by a shader; use --backend cpu");
    work.unfinished = 1;
    EXPECT_EQ(
        error_of(work),
        "a device: the driver stopped a shader before it finished; use another device or --backend cpu");
}

} // namespace
} // namespace nusselt::render_vulkan_test
