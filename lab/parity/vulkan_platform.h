#pragma once
/// Runs shaders on a Vulkan device.

#include "gpu/device.h"
#include "lab/parity/shader_platform.h"

namespace nusselt::parity {

class VulkanPlatform : public ShaderPlatform {
public:
    /// \param device outlives this object and all that it loads
    explicit VulkanPlatform(const gpu::Device& device) : device_(&device) {}

    std::vector<Variant> variants() const override;
    std::unique_ptr<ShaderRunner> load(const VariantShader& shader, std::size_t input_size,
                                       std::span<const std::uint32_t> words) const override;

private:
    const gpu::Device* device_;
};

} // namespace nusselt::parity
