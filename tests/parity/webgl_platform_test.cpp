// Shaders run in a browser. Most of what runs there is tested by the comparisons of parity_test.cpp.

#include "webgl_platform.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace nusselt::parity {

namespace {

class WebglPlatformTest : public testing::Test {
protected:
    void SetUp() override {
        // With CI=true, tests/browser/shader_host.py fails before it runs this program.
        if (WebglPlatform::shared() == nullptr)
            GTEST_SKIP()
                << "no browser: tests/browser/shader_host.py did not start this program, or found none";
    }
};

TEST_F(WebglPlatformTest, TellsWhyAShaderDoesNotRun) {
    const Shader missing{"no_such_shader", {}};
    EXPECT_THROW(
        try { WebglPlatform::shared()->load(missing, 1, {}); } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find("no_such_shader"), std::string::npos) << error.what();
            throw;
        },
        std::runtime_error);
}

} // namespace

} // namespace nusselt::parity
