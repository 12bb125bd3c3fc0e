#pragma once
/// Fixture of tests that run shaders on a Vulkan device and, where there is one, in a browser.

#include "gpu_test.h"
#include "lab/parity/parity_check.h"
#include "lab/parity/vulkan_platform.h"
#include "webgl_platform.h"

#include <optional>
#include <utility>
#include <vector>

namespace nusselt::parity {

/// Exact results, which take most of the time, are computed once for both.
class DeviceAndBrowser : public ShaderPlatform {
public:
    explicit DeviceAndBrowser(const gpu::Device& device) : vulkan_(device) {}

    std::vector<Variant> variants() const override {
        std::vector<Variant> all = vulkan_.variants();
        if (WebglPlatform::shared() != nullptr) all.push_back(Variant::webgl);
        return all;
    }
    std::unique_ptr<ShaderRunner> load(const VariantShader& shader, std::size_t input_size,
                                       std::span<const std::uint32_t> words) const override {
        if (shader.variant == Variant::webgl) return WebglPlatform::shared()->load(shader, input_size, words);
        return vulkan_.load(shader, input_size, words);
    }
    const VulkanPlatform& vulkan() const { return vulkan_; }

private:
    VulkanPlatform vulkan_;
};

class PlatformTest : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure()) platform_.emplace(device());
    }

    const DeviceAndBrowser& platform() const { return *platform_; }

    /// A wrong shader, on the device and in the browser.
    std::vector<VariantShader> wherever_it_runs(const Shader& shader) const {
        std::vector<VariantShader> shaders{shader};
        if (WebglPlatform::shared() != nullptr) shaders.emplace_back(shader, Variant::webgl);
        return shaders;
    }

    /// What the comparison found, for each shader.
    static std::vector<std::pair<Variant, std::vector<std::string>>>
    excesses_of_each(const std::vector<VariantShader>& shaders, const std::vector<Verdict>& verdicts) {
        std::vector<std::pair<Variant, std::vector<std::string>>> found;
        for (std::size_t k = 0; k < shaders.size(); ++k)
            found.emplace_back(shaders[k].variant, verdicts[k].excesses);
        return found;
    }

    /// A wrong shader that takes long to compile: in the browser if there is one, where it takes less time. What has to find it
    /// is the same.
    VariantShader where_it_compiles_fast(const Shader& shader) const {
        return wherever_it_runs(shader).back();
    }

private:
    std::optional<DeviceAndBrowser> platform_;
};

} // namespace nusselt::parity
