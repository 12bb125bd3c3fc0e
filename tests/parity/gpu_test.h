#pragma once
/// Fixture of tests on a Vulkan device. Without a device they are skipped, visibly; whatever the validation layer
/// says is a failure.

#include "gpu/device.h"

#include <gtest/gtest.h>

namespace nusselt::parity {

class GpuTest : public testing::Test {
protected:
    void SetUp() override {
        if (const auto reason = gpu::why_no_device()) GTEST_SKIP() << *reason;
        device_.emplace(gpu::DeviceOptions{.validation = gpu::Validation::on});
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
