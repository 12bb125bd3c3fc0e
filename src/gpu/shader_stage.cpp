#include "gpu/shader_stage.h"

#include <utility>

namespace nusselt::gpu {

namespace {

std::vector<vk::SpecializationMapEntry> make_entries(std::size_t count) {
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < count; ++i)
        entries.emplace_back(i, static_cast<std::uint32_t>(sizeof(std::uint32_t)) * i, sizeof(std::uint32_t));
    return entries;
}

} // namespace

ShaderStage::ShaderStage(const Device& device, vk::ShaderStageFlagBits stage,
                         std::span<const std::uint32_t> spirv, std::vector<std::uint32_t> constants)
    : constants_(std::move(constants)),
      entries_(make_entries(constants_.size())),
      specialization_(static_cast<std::uint32_t>(entries_.size()), entries_.data(),
                      constants_.size() * sizeof(std::uint32_t), constants_.data()),
      module_(device.handle(),
              vk::ShaderModuleCreateInfo({}, spirv.size() * sizeof(std::uint32_t), spirv.data())),
      description_({}, stage, *module_, "main", &specialization_) {}

} // namespace nusselt::gpu
