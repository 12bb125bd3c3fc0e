#include "gpu/compute_pipeline.h"

#include "gpu/shader_stage.h"

#include <cassert>

namespace nusselt::gpu {

namespace {

vk::raii::PipelineLayout make_layout(const Device& device, const ComputeInterface& interface,
                                     const ShaderBindings& bindings) {
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, interface.push_constant_size);
    const std::vector<vk::DescriptorSetLayout> sets = bindings.layouts();
    vk::PipelineLayoutCreateInfo info({}, sets);
    if (interface.push_constant_size > 0) info.setPushConstantRanges(push);
    return {device.handle(), info};
}

vk::raii::Pipeline make_pipeline(const Device& device, std::span<const std::uint32_t> spirv,
                                 const ComputeInterface& interface, vk::PipelineLayout layout) {
    const ShaderStage stage(device, vk::ShaderStageFlagBits::eCompute, spirv, interface.constants);
    return {device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage.description(), layout)};
}

} // namespace

ComputePipeline::ComputePipeline(const Device& device, std::span<const std::uint32_t> spirv,
                                 const ComputeInterface& interface) try
    : push_constant_size_(interface.push_constant_size),
      bindings_(device, interface.storage_buffers, interface.ray_scenes, interface.images,
                vk::ShaderStageFlagBits::eCompute),
      layout_(make_layout(device, interface, bindings_)),
      pipeline_(make_pipeline(device, spirv, interface, *layout_)) {
} catch (const vk::SystemError& error) {
    rethrow(device.description().name + ": compiling a shader", error);
}

void ComputePipeline::dispatch(const Device::Commands& commands, std::span<const std::byte> push,
                               std::uint32_t groups, std::uint32_t groups_y) const {
    assert(push.size() == push_constant_size_);
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, bindings_.handles(), {});
    if (!push.empty())
        commands.pushConstants<std::byte>(
            *layout_, vk::ShaderStageFlagBits::eCompute, 0,
            vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    commands.dispatch(groups, groups_y, 1);
}

} // namespace nusselt::gpu
