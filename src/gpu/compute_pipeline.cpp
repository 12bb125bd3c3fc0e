#include "gpu/compute_pipeline.h"

#include <cassert>
#include <vector>

namespace nusselt::gpu {

namespace {

vk::raii::DescriptorSetLayout make_set_layout(const Device& device, const ComputeInterface& interface) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < interface.storage_buffers; ++i)
        bindings.emplace_back(i, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eCompute);
    for (std::uint32_t i = 0; i < interface.ray_scenes; ++i)
        bindings.emplace_back(interface.storage_buffers + i, vk::DescriptorType::eAccelerationStructureKHR, 1,
                              vk::ShaderStageFlagBits::eCompute);
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout make_layout(const Device& device, const ComputeInterface& interface,
                                     vk::DescriptorSetLayout set_layout) {
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, interface.push_constant_size);
    vk::PipelineLayoutCreateInfo info({}, set_layout);
    if (interface.push_constant_size > 0) info.setPushConstantRanges(push);
    return {device.handle(), info};
}

vk::raii::Pipeline make_pipeline(const Device& device, std::span<const std::uint32_t> spirv,
                                 const ComputeInterface& interface, vk::PipelineLayout layout) {
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < interface.constants.size(); ++i)
        entries.emplace_back(i, static_cast<std::uint32_t>(sizeof(std::uint32_t)) * i, sizeof(std::uint32_t));
    const vk::SpecializationInfo constants(static_cast<std::uint32_t>(entries.size()), entries.data(),
                                           interface.constants.size() * sizeof(std::uint32_t),
                                           interface.constants.data());
    const vk::raii::ShaderModule module(
        device.handle(), vk::ShaderModuleCreateInfo({}, spirv.size() * sizeof(std::uint32_t), spirv.data()));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  &constants);
    return {device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage, layout)};
}

vk::raii::DescriptorPool make_descriptor_pool(const Device& device, const ComputeInterface& interface) {
    std::vector<vk::DescriptorPoolSize> sizes = {
        {vk::DescriptorType::eStorageBuffer, std::max(interface.storage_buffers, 1u)}};
    if (interface.ray_scenes > 0)
        sizes.emplace_back(vk::DescriptorType::eAccelerationStructureKHR, interface.ray_scenes);
    return {device.handle(), vk::DescriptorPoolCreateInfo({}, 1, sizes)};
}

} // namespace

ComputePipeline::ComputePipeline(const Device& device, std::span<const std::uint32_t> spirv,
                                 const ComputeInterface& interface) try
    : interface_(interface),
      device_(&device),
      set_layout_(make_set_layout(device, interface)),
      layout_(make_layout(device, interface, *set_layout_)),
      pipeline_(make_pipeline(device, spirv, interface, *layout_)),
      descriptor_pool_(make_descriptor_pool(device, interface)) {
    const vk::DescriptorSetAllocateInfo info(*descriptor_pool_, *set_layout_);
    descriptors_ = vk::raii::DescriptorSets(device.handle(), info).front().release();
} catch (const vk::SystemError& error) {
    rethrow(device.description().name + ": compiling a shader", error);
}

void ComputePipeline::bind(std::initializer_list<const Buffer*> buffers) {
    assert(buffers.size() == interface_.storage_buffers);
    std::uint32_t binding = 0;
    for (const Buffer* buffer : buffers) {
        const vk::DescriptorBufferInfo info(buffer->handle(), 0, VK_WHOLE_SIZE);
        device_->handle().updateDescriptorSets(
            vk::WriteDescriptorSet(descriptors_, binding++, 0, vk::DescriptorType::eStorageBuffer, {}, info),
            {});
    }
}

void ComputePipeline::bind(const AccelerationStructure& scene) {
    assert(interface_.ray_scenes == 1);
    const vk::AccelerationStructureKHR handle = scene.handle();
    const vk::WriteDescriptorSetAccelerationStructureKHR info(handle);
    vk::WriteDescriptorSet write(descriptors_, interface_.storage_buffers, 0, 1,
                                 vk::DescriptorType::eAccelerationStructureKHR);
    write.pNext = &info;
    device_->handle().updateDescriptorSets(write, {});
}

void ComputePipeline::dispatch(const Device::Commands& commands, std::span<const std::byte> push,
                               std::uint32_t groups) const {
    assert(push.size() == interface_.push_constant_size);
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, descriptors_, {});
    if (!push.empty())
        commands.pushConstants<std::byte>(
            *layout_, vk::ShaderStageFlagBits::eCompute, 0,
            vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    commands.dispatch(groups, 1, 1);
}

} // namespace nusselt::gpu
