#pragma once
/// What tests of shadow rays in shaders have in common.

#include "gpu_test.h"
#include "gpu_tracer.h"

#include <random>
#include <string>
#include <vector>

namespace nusselt::gpu_visibility_test {

/// A device that traces shadow rays in one of the ways.
class GpuShadows : public parity::GpuTest, public testing::WithParamInterface<Way> {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (IsSkipped() || HasFatalFailure() || GetParam() == Way::bvh) return;
        if (device().features().ray_queries) return;
        const std::string& driver = device().description().driver;
        EXPECT_EQ(driver.find("Mesa 25"), std::string::npos) << driver << " has ray queries";
        GTEST_SKIP() << driver << " does not support ray queries";
    }

    std::vector<std::uint32_t> trace(const scene::Scene& scene, const std::vector<Ray>& rays) const {
        return GpuTracer(device(), scene, GetParam()).trace(rays);
    }

    std::mt19937 random_{7};
};

} // namespace nusselt::gpu_visibility_test
