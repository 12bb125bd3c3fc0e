#include "gpu/shader_bindings.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <vector>

namespace nusselt::gpu {

namespace {

vk::raii::DescriptorSetLayout make_layout(const Device& device, std::uint32_t storage_buffers,
                                          std::uint32_t ray_scenes, vk::ShaderStageFlags stages) {
    const std::uint32_t limit = std::min(device.limits().maxPerStageDescriptorStorageBuffers,
                                         device.limits().maxDescriptorSetStorageBuffers);
    if (storage_buffers > limit)
        throw Error(device.description().name + ": the device supports at most " + std::to_string(limit) +
                    " storage buffers per shader, found " + std::to_string(storage_buffers) +
                    "; choose another one with NUSSELT_DEVICE");
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t i = 0; i < storage_buffers; ++i)
        bindings.emplace_back(i, vk::DescriptorType::eStorageBuffer, 1, stages);
    for (std::uint32_t i = 0; i < ray_scenes; ++i)
        bindings.emplace_back(storage_buffers + i, vk::DescriptorType::eAccelerationStructureKHR, 1, stages);
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::DescriptorPool make_pool(const Device& device, std::uint32_t storage_buffers,
                                   std::uint32_t ray_scenes) {
    std::vector<vk::DescriptorPoolSize> sizes = {
        {vk::DescriptorType::eStorageBuffer, std::max(storage_buffers, 1u)}};
    if (ray_scenes > 0) sizes.emplace_back(vk::DescriptorType::eAccelerationStructureKHR, ray_scenes);
    return {device.handle(), vk::DescriptorPoolCreateInfo({}, 1, sizes)};
}

} // namespace

ShaderBindings::ShaderBindings(const Device& device, std::uint32_t storage_buffers, std::uint32_t ray_scenes,
                               const ImageArray* images, vk::ShaderStageFlags stages)
    : device_(&device),
      storage_buffers_(storage_buffers),
      ray_scenes_(ray_scenes),
      images_(images),
      layout_(make_layout(device, storage_buffers, ray_scenes, stages)),
      pool_(make_pool(device, storage_buffers, ray_scenes)) {
    const vk::DescriptorSetAllocateInfo info(*pool_, *layout_);
    set_ = vk::raii::DescriptorSets(device.handle(), info).front().release();
}

std::vector<vk::DescriptorSetLayout> ShaderBindings::layouts() const {
    if (images_ == nullptr) return {*layout_};
    return {*layout_, images_->layout()};
}

std::vector<vk::DescriptorSet> ShaderBindings::handles() const {
    if (images_ == nullptr) return {set_};
    return {set_, images_->handle()};
}

void ShaderBindings::bind(std::span<const Buffer* const> buffers) {
    assert(buffers.size() == storage_buffers_);
    std::uint32_t binding = 0;
    for (const Buffer* buffer : buffers) {
        const vk::DescriptorBufferInfo info(buffer->handle(), 0, VK_WHOLE_SIZE);
        device_->handle().updateDescriptorSets(
            vk::WriteDescriptorSet(set_, binding++, 0, vk::DescriptorType::eStorageBuffer, {}, info), {});
    }
}

void ShaderBindings::bind(const AccelerationStructure& scene) {
    assert(ray_scenes_ == 1);
    const vk::AccelerationStructureKHR handle = scene.handle();
    const vk::WriteDescriptorSetAccelerationStructureKHR info(handle);
    vk::WriteDescriptorSet write(set_, storage_buffers_, 0, 1, vk::DescriptorType::eAccelerationStructureKHR);
    write.pNext = &info;
    device_->handle().updateDescriptorSets(write, {});
}

} // namespace nusselt::gpu
