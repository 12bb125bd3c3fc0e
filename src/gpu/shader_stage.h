#pragma once
/// Shaders with their specialisation constants.

#include "gpu/device.h"

#include <cstdint>
#include <span>
#include <vector>

namespace nusselt::gpu {

/// The data of a shader that a pipeline needs while it is created.
class ShaderStage {
public:
    /// \param spirv     a shader with the entry point `main`.
    /// \param constants specialisation constants 0, 1, ...: the bits of each.
    ShaderStage(const Device& device, vk::ShaderStageFlagBits stage, std::span<const std::uint32_t> spirv,
                std::vector<std::uint32_t> constants);
    // The description keeps addresses of members.
    ShaderStage(const ShaderStage&) = delete;
    ShaderStage& operator=(const ShaderStage&) = delete;

    const vk::PipelineShaderStageCreateInfo& description() const { return description_; }

private:
    std::vector<std::uint32_t> constants_;
    std::vector<vk::SpecializationMapEntry> entries_;
    vk::SpecializationInfo specialization_;
    vk::raii::ShaderModule module_;
    vk::PipelineShaderStageCreateInfo description_;
};

} // namespace nusselt::gpu
