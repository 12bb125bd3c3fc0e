#include "common/environment.h"
#include "gpu/compute_pipeline.h"
#include "gpu/fused_fma.h"
#include "gpu_test.h"
#include "shaders/scaled_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <functional>

namespace nusselt::parity {

namespace {

struct Push {
    float scale;
    std::uint32_t count;
};

class DeviceTest : public GpuTest, public testing::WithParamInterface<gpu::Residence> {};

TEST_P(DeviceTest, RunsAShader) {
    constexpr std::uint32_t kCount = 1000; // not a multiple of the size of a work group
    std::vector<float> a(kCount), b(kCount), sums(kCount + 24, -1.0f);
    for (std::uint32_t i = 0; i < kCount; ++i) {
        a[i] = static_cast<float>(i);
        b[i] = 0.5f * static_cast<float>(i % 7);
    }
    gpu::Buffer in_a(device(), kCount * sizeof(float), GetParam());
    gpu::Buffer in_b(device(), kCount * sizeof(float), GetParam());
    gpu::Buffer out(device(), sums.size() * sizeof(float), GetParam());
    in_a.write<float>(a);
    in_b.write<float>(b);
    out.write<float>(sums);

    gpu::ComputePipeline pipeline(device(), shaders::kScaledSums,
                                  {.storage_buffers = 3,
                                   .push_constant_size = sizeof(Push),
                                   .constants = {std::bit_cast<std::uint32_t>(0.25f), 2}});
    pipeline.bind({&in_a, &in_b, &out});
    const Push push{4, kCount};
    device().run([&](const gpu::Device::Commands& commands) {
        pipeline.dispatch(commands, std::as_bytes(std::span(&push, 1)), (kCount + 63) / 64);
    });
    out.read<float>(sums);
    for (std::uint32_t i = 0; i < kCount; ++i)
        ASSERT_EQ(sums[i], 4 * (a[i] + b[i]) + 0.25f + 2 * static_cast<float>(i)) << i;
    for (std::size_t i = kCount; i < sums.size(); ++i) EXPECT_EQ(sums[i], -1) << "written beyond the count";
}

INSTANTIATE_TEST_SUITE_P(AnyMemory, DeviceTest,
                         testing::Values(gpu::Residence::host_visible, gpu::Residence::device_local),
                         [](const auto& residence) {
                             return residence.param == gpu::Residence::host_visible ? "host_visible"
                                                                                    : "device_local";
                         });

class DevicesTest : public GpuTest {};

TEST_F(DevicesTest, TimesCommands) {
    gpu::Buffer large(device(), std::size_t{32} << 20, gpu::Residence::device_local);
    const auto fill = [&](int times) {
        return device().time([&](const gpu::Device::Commands& commands) {
            for (int i = 0; i < times; ++i) {
                commands.fillBuffer(large.handle(), 0, VK_WHOLE_SIZE, static_cast<std::uint32_t>(i));
                gpu::full_barrier(commands);
            }
        });
    };
    const double once = std::min({fill(1), fill(1), fill(1), fill(1)});
    EXPECT_GT(once, 1e3) << "32 MiB in less than a microsecond";
    EXPECT_GT(fill(64), 8 * once) << "compared with the shortest of several";
}

TEST_F(DevicesTest, AreListedAndChosenByNameOrIndex) {
    const auto devices = gpu::list_devices();
    ASSERT_FALSE(devices.empty());
    for (std::size_t i = 0; i < devices.size(); ++i)
        EXPECT_EQ(gpu::Device({.choice = std::to_string(i)}).description().name, devices[i].name);
    std::string part = devices[0].name.substr(0, 4);
    for (char& c : part) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_EQ(gpu::Device({.choice = part}).description().name, devices[0].name);
    const nusselt_test::ScopedVariable variable("NUSSELT_DEVICE", part.c_str());
    EXPECT_EQ(gpu::Device().description().name, devices[0].name);
}

TEST_F(DevicesTest, UnknownNameIsAnErrorThatListsTheDevices) {
    const auto reason = gpu::why_no_device({.choice = "no such device"});
    ASSERT_TRUE(reason);
    EXPECT_NE(reason->find("'no such device'"), std::string::npos) << *reason;
    EXPECT_NE(reason->find(gpu::list_devices()[0].name), std::string::npos) << *reason;
    EXPECT_EQ(reason->find('\n'), std::string::npos) << *reason;
}

TEST_F(DevicesTest, NumberIsAnIndexAndNoPartOfAName) {
    // The name of llvmpipe has "256 bits" in it.
    EXPECT_TRUE(gpu::why_no_device({.choice = "256"}));
    EXPECT_FALSE(gpu::why_no_device({.choice = "0"}));
}

TEST_F(DevicesTest, BuffersBeyondTheLimitAreAnError) {
    const std::size_t limit = device().limits().maxStorageBufferRange;
    try {
        const gpu::Buffer buffer(device(), limit + 4, gpu::Residence::host_visible);
        FAIL() << "no error";
    } catch (const gpu::Error& error) {
        EXPECT_NE(std::string(error.what()).find("exceeds the limit"), std::string::npos) << error.what();
    }
}

TEST_F(DevicesTest, MemoryBeyondTheDeviceIsAnError) {
    const vk::MemoryRequirements requirements(std::uint64_t{1} << 50, 64, ~0u);
    try {
        const auto memory = device().allocate(requirements, vk::MemoryPropertyFlagBits::eDeviceLocal);
        FAIL() << "no error";
    } catch (const gpu::Error& error) {
        EXPECT_EQ(error.what(), device().description().name +
                                    ": allocating 1073741824 MiB of memory: out of memory on the "
                                    "device; close other programs, or use a smaller scene or image");
    }
}

TEST_F(DevicesTest, MoreBindingsThanTheDeviceHasAreAnError) {
    const std::uint32_t limit = std::min(device().limits().maxPerStageDescriptorStorageBuffers,
                                         device().limits().maxDescriptorSetStorageBuffers);
    try {
        const gpu::ComputePipeline pipeline(device(), shaders::kScaledSums, {.storage_buffers = limit + 1});
        FAIL() << "no error";
    } catch (const gpu::Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("supports at most " + std::to_string(limit)), std::string::npos) << text;
        EXPECT_NE(text.find("NUSSELT_DEVICE"), std::string::npos) << text;
    }
}

TEST_F(DevicesTest, LossIsAnErrorThatNamesTheDevice) {
    const auto lose = [](const gpu::Device::Commands&) { throw vk::DeviceLostError("vkQueueSubmit"); };
    const gpu::Device::Record passes[] = {lose, lose};
    for (const std::function<void()>& use :
         {std::function([&] { device().run(lose); }), std::function([&] { device().time_passes(passes); })})
        try {
            use();
            FAIL() << "no error";
        } catch (const gpu::Error& error) {
            EXPECT_EQ(std::string(error.what()).rfind(device().description().name + ": ", 0), 0u);
            EXPECT_NE(std::string(error.what()).find("the device is lost"), std::string::npos);
        }
    const gpu::Buffer buffer(device(), 64, gpu::Residence::device_local);
}

TEST_F(DevicesTest, ValidationReportsWrongUse) {
    if (!device().validates()) GTEST_SKIP() << "the validation layer is not installed";
    const gpu::Buffer buffer(device(), 64, gpu::Residence::host_visible);
    device().run([&](const gpu::Device::Commands& commands) {
        commands.fillBuffer(buffer.handle(), 2, 8, 0u); // offsets are multiples of four
    });
    const auto messages = device().take_validation_messages();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_NE(messages[0].find("dstOffset"), std::string::npos) << messages[0];
}

TEST_F(DevicesTest, FusedFmaOfSoftwareDevicesIsKnown) {
    // LLVMpipe of Mesa 22 never fuses. Whether other drivers fuse depends on the hardware; some of them belong to
    // Mesa, too.
    const bool fused = gpu::has_fused_fma(device());
    const auto& description = device().description();
    if (description.kind != "CPU" || description.driver.find("Mesa 22") == std::string::npos)
        GTEST_SKIP() << description.driver;
    EXPECT_FALSE(fused);
}

TEST(NoDevice, IsAnErrorInOneLine) {
    const nusselt_test::ScopedVariable variable("VK_ICD_FILENAMES", "/nonexistent.json");
    const nusselt_test::ScopedVariable same("VK_DRIVER_FILES", "/nonexistent.json");
    EXPECT_TRUE(gpu::list_devices().empty());
    const auto reason = gpu::why_no_device();
    ASSERT_TRUE(reason);
    EXPECT_EQ(reason->find('\n'), std::string::npos);
    EXPECT_NE(reason->find("mesa-vulkan-drivers"), std::string::npos) << *reason;
    EXPECT_THROW(gpu::Device(), gpu::NoDevice);
}

TEST(GpuErrors, SayWhatToDo) {
    const auto text = [](vk::Result result) { return gpu::describe("a frame", result); };
    EXPECT_NE(text(vk::Result::eErrorDeviceLost).find("run the program again"), std::string::npos);
    EXPECT_NE(text(vk::Result::eErrorOutOfDeviceMemory).find("out of memory on the device"),
              std::string::npos);
    EXPECT_EQ(text(vk::Result::eErrorUnknown),
              "a frame: Vulkan reports ErrorUnknown; update the driver, or choose "
              "another device with NUSSELT_DEVICE");
}

TEST(GpuErrors, StateSizes) {
    EXPECT_EQ(gpu::size_text(12), "12 bytes");
    EXPECT_EQ(gpu::size_text(1500), "2 KiB");
    EXPECT_EQ(gpu::size_text(std::size_t{3} << 20), "3 MiB");
    EXPECT_EQ(gpu::size_text((std::size_t{3} << 20) + 4), "4 MiB");
}

TEST(GpuTests, NeedADeviceWhereOneIsAskedFor) {
    for (const char* name : {"CI", "NUSSELT_DEVICE", "NUSSELT_EXPECT_DRIVER"}) {
        const nusselt_test::ScopedVariable ci("CI", ""), choice("NUSSELT_DEVICE", ""),
            driver("NUSSELT_EXPECT_DRIVER", "");
        EXPECT_FALSE(needs_device());
        const nusselt_test::ScopedVariable variable(name, "true");
        EXPECT_TRUE(needs_device()) << name;
    }
}

TEST(GpuErrors, ExceptionsOfVulkanAreTranslated) {
    try {
        gpu::guarded("a frame", [] { throw vk::DeviceLostError("vkQueueSubmit"); });
        FAIL() << "no error";
    } catch (const gpu::Error& error) {
        EXPECT_EQ(error.what(), gpu::describe("a frame", vk::Result::eErrorDeviceLost));
    }
}

} // namespace

} // namespace nusselt::parity
