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

class GpuTest : public testing::Test {
protected:
    void SetUp() override {
        if (const auto reason = gpu::why_no_device()) {
            if (needs_device()) FAIL() << *reason;
            GTEST_SKIP() << *reason;
        }
        device_.emplace(gpu::DeviceOptions{.validation = gpu::Validation::on});
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
    std::optional<gpu::Device> device_;
};

} // namespace nusselt::parity
