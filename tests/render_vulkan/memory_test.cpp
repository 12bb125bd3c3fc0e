/// The memory that the renderer leaks, and its behaviour without memory.

#include "debug_allocator.h"
#include "gpu_test.h"
#include "rich_scene.h"

#include "render_vulkan/accumulator.h"
#include "render_vulkan/frame_records.h"
#include "render_vulkan/renderer.h"
#include "render_vulkan/scene_buffers.h"

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace nusselt::render_vulkan_test {
namespace {

using parity::DebugAllocator;
using render_vulkan::Accumulator;
using render_vulkan::DeviceScene;
using render_vulkan::ShadowRays;
using render_vulkan::VulkanRenderer;

/// A device whose driver keeps its objects where they are counted. It is that of all tests, as it keeps what was compiled.
class Memory : public parity::GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (HasFatalFailure() || IsSkipped()) return;
        if (!counted_)
            counted_.emplace(
                gpu::DeviceOptions{.validation = gpu::Validation::on, .allocator = allocator().callbacks()});
        const std::size_t before = allocator().live();
        const gpu::Buffer buffer(counted(), 64, gpu::Residence::device_local);
        if (allocator().live() == before) GTEST_SKIP() << "the driver keeps its objects elsewhere";
    }

    void TearDown() override {
        if (counted_)
            for (const std::string& message : counted_->take_validation_messages()) ADD_FAILURE() << message;
        GpuTest::TearDown();
    }

    static void TearDownTestSuite() {
        counted_.reset();
        EXPECT_EQ(allocator().live(), 0u);
    }

    const gpu::Device& counted() const { return *counted_; }
    /// The live memory once all work has ended: threads of drivers clean up after they have reported the end.
    static std::size_t settled() {
        std::size_t live = allocator().live();
        for (int unchanged = 0; unchanged < 50; ++unchanged) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            if (allocator().live() != live) unchanged = 0;
            live = allocator().live();
        }
        return live;
    }
    static DebugAllocator& allocator() {
        static DebugAllocator shared;
        return shared;
    }

private:
    static inline std::optional<gpu::Device> counted_;
};

/// Those whose shader drivers compile in the least time.
render::RenderSettings quick_settings() {
    render::RenderSettings settings;
    settings.technique = render::Technique::area;
    settings.brdf = render::BrdfChoice::lambert;
    return settings;
}

TEST_F(Memory, IsCounted) {
    const std::size_t before = allocator().live();
    {
        const gpu::Buffer buffer(counted(), 64, gpu::Residence::device_local);
        EXPECT_GE(allocator().live(), before + 2) << "the buffer and its memory";
    }
    EXPECT_EQ(allocator().live(), before);
}

TEST_F(Memory, IsGivenBackByRenderers) {
    const scene::Scene scene = make_rich_scene(8, 8);
    std::vector<ShadowRays> ways = {ShadowRays::bvh, ShadowRays::none};
    if (counted().features().ray_queries) ways.push_back(ShadowRays::query);
    const auto render = [&](ShadowRays way) {
        const std::size_t before = settled();
        VulkanRenderer renderer(counted(), scene, way);
        render::RenderSettings settings = quick_settings();
        static_cast<void>(renderer.render(settings));
        settings.technique = render::Technique::ltc_analytic;
        static_cast<void>(renderer.render(settings));
        EXPECT_GT(settled(), before + 20) << "buffers and images";
    };
    for (const ShadowRays way : ways) {
        render(way); // the device keeps what was compiled
        const std::size_t before = settled();
        render(way);
        EXPECT_EQ(settled(), before) << name_of(way);
    }
}

TEST_F(Memory, StaysTheSameOverAThousandFrames) {
    const DeviceScene scene(counted(), make_rich_scene(8, 8), ShadowRays::bvh);
    render::RenderSettings settings = quick_settings();
    settings.samples = 1000;
    Accumulator image(scene, settings);
    const render_vulkan::FrameRecords frames(scene.film(), settings);
    ASSERT_EQ(frames.count(), 1000u);
    image.add(frames.make(0));
    const std::size_t before = settled();
    for (std::uint32_t i = 1; i < frames.count(); ++i) image.add(frames.make(i));
    EXPECT_EQ(image.frames(), 1000u);
    EXPECT_EQ(settled(), before);
}

TEST_F(Memory, LackOfItIsAMessage) {
    const std::size_t before = settled();
    for (const std::size_t allowed : {0u, 1u}) {
        allocator().allow(allowed);
        try {
            const gpu::Buffer buffer(counted(), 64, gpu::Residence::device_local);
            ADD_FAILURE() << "a buffer and its memory need more than " << allowed;
        } catch (const gpu::Error& error) {
            const std::string text = error.what();
            EXPECT_EQ(text.rfind(counted().description().name + ": ", 0), 0u) << text;
            EXPECT_NE(text.find("out of memory; close other programs, or use a smaller scene or image"),
                      std::string::npos)
                << text;
        }
        allocator().allow_all();
        EXPECT_EQ(settled(), before);
    }
}

TEST_F(Memory, LackOfItForAScenesBufferNamesWhatIsTooLarge) {
    const std::size_t limit = counted().limits().maxStorageBufferRange;
    if (limit > std::size_t{1} << 30) GTEST_SKIP() << "the device has buffers of " << gpu::size_text(limit);
    const std::vector<float> texels(limit / sizeof(float) + 1);
    const std::size_t before = settled();
    try {
        render_vulkan::upload(counted(), std::span(texels), "texels");
        FAIL() << "no error";
    } catch (const gpu::Error& error) {
        EXPECT_EQ(error.what(), counted().description().name + ": the texels of the scene take " +
                                    gpu::size_text(limit + 4) +
                                    ", but buffers of this device are limited to " + gpu::size_text(limit) +
                                    "; use another device or --backend cpu");
    }
    EXPECT_EQ(settled(), before);
}

} // namespace
} // namespace nusselt::render_vulkan_test
