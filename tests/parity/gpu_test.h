#pragma once
/// Fixture of tests on a Vulkan device. Without a loader or any device, the tests are reported as skipped, unless the
/// environment asks for a device. A driver that does not start is a failure, and so is any message of the validation
/// layer.

#include "gpu/device.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace nusselt::parity {

/// Whether the environment asks for a device. It does with CI=true (these machines install a software device),
/// NUSSELT_DEVICE, or NUSSELT_EXPECT_DRIVER, which is a part of the name or version of the driver to run.
inline bool needs_device() {
    const auto value = [](const char* name) -> std::string {
        const char* text = std::getenv(name);
        return text == nullptr ? "" : text;
    };
    return value("CI") == "true" || !value("NUSSELT_DEVICE").empty() ||
           !value("NUSSELT_EXPECT_DRIVER").empty();
}

/// The device of all tests of a process: it keeps the shaders that drivers compiled, which takes longer than most tests.
class SharedDevice : public testing::Environment {
public:
    /// Created at the first call.
    const gpu::Device& get() {
        if (!device_) device_.emplace(gpu::DeviceOptions{.validation = gpu::Validation::on});
        return *device_;
    }

    void TearDown() override { device_.reset(); }

private:
    std::optional<gpu::Device> device_;
};

/// GoogleTest owns it.
inline SharedDevice* const shared_device = [] {
    auto* const shared = new SharedDevice;
    testing::AddGlobalTestEnvironment(shared);
    return shared;
}();

class GpuTest : public testing::Test {
protected:
    void SetUp() override {
        if (const auto reason = gpu::why_no_device()) {
            if (needs_device()) FAIL() << *reason;
            GTEST_SKIP() << *reason;
        }
        device_ = &shared_device->get();
        const std::string driver = device().description().driver;
        if (const char* expected = std::getenv("NUSSELT_EXPECT_DRIVER")) {
            ASSERT_NE(driver.find(expected), std::string::npos) << driver << " is not " << expected;
        }
    }

    void TearDown() override {
        if (!device_) return;
        for (const std::string& message : device_->take_validation_messages()) ADD_FAILURE() << message;
    }

    const gpu::Device& device() const { return *device_; }

private:
    const gpu::Device* device_ = nullptr;
};

} // namespace nusselt::parity
