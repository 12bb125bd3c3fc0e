#include "gpu/buffer.h"

#include <cassert>
#include <cstring>

namespace nusselt::gpu {

namespace {

/// The name of a buffer in messages.
std::string name_of(const Device& device, std::size_t bytes) {
    return device.description().name + ": a buffer of " + size_text(bytes);
}

vk::raii::Buffer make_buffer(const Device& device, std::size_t bytes, vk::BufferUsageFlags use) {
    assert(bytes > 0);
    // Memory that shaders and builders reach by address has no limit.
    const bool is_bound = (use & vk::BufferUsageFlagBits::eStorageBuffer) &&
                          !(use & vk::BufferUsageFlagBits::eShaderDeviceAddress);
    if (is_bound && bytes > device.limits().maxStorageBufferRange)
        throw Error(name_of(device, bytes) + " exceeds the limit of " +
                    size_text(device.limits().maxStorageBufferRange) + "; use a smaller scene or image");
    const vk::BufferCreateInfo info({}, bytes, use);
    return guarded(name_of(device, bytes), [&] { return vk::raii::Buffer(device.handle(), info); });
}

vk::MemoryPropertyFlags properties_of(const Device& device, const vk::MemoryRequirements& requirements,
                                      Residence residence) {
    using Property = vk::MemoryPropertyFlagBits;
    if (residence == Residence::device_local) return Property::eDeviceLocal;
    const vk::MemoryPropertyFlags visible = Property::eHostVisible | Property::eHostCoherent;
    const vk::MemoryPropertyFlags cached = visible | Property::eHostCached;
    return residence == Residence::read_back && device.has_memory(requirements, cached) ? cached : visible;
}

} // namespace

Buffer::Buffer(const Device& device, std::size_t bytes, Residence residence, vk::BufferUsageFlags use)
    : device_(&device),
      size_(bytes),
      residence_(residence),
      buffer_(make_buffer(device, bytes, use)),
      memory_(device.allocate(buffer_.getMemoryRequirements(),
                              properties_of(device, buffer_.getMemoryRequirements(), residence), use)) {
    guarded(name_of(device, bytes), [&] { buffer_.bindMemory(*memory_, 0); });
}

vk::DeviceAddress Buffer::address() const { return device_->handle().getBufferAddress({*buffer_}); }

void Buffer::write_bytes(std::span<const std::byte> bytes) {
    assert(bytes.size() <= size_);
    if (residence_ == Residence::device_local) {
        Buffer staging(*device_, bytes.size(), Residence::host_visible,
                       vk::BufferUsageFlagBits::eTransferSrc);
        staging.write_bytes(bytes);
        device_->run([&](const Device::Commands& commands) {
            commands.copyBuffer(staging.handle(), handle(), vk::BufferCopy(0, 0, bytes.size()));
        });
        return;
    }
    guarded(name_of(*device_, size_) + " that is written", [&] {
        std::memcpy(memory_.mapMemory(0, bytes.size()), bytes.data(), bytes.size());
        memory_.unmapMemory();
    });
}

void Buffer::fill_with_zeros() {
    device_->run(
        [&](const Device::Commands& commands) { commands.fillBuffer(handle(), 0, VK_WHOLE_SIZE, 0); });
}

void Buffer::read_bytes(std::span<std::byte> bytes) const {
    assert(bytes.size() <= size_);
    if (residence_ == Residence::device_local) {
        const Buffer staging(*device_, bytes.size(), Residence::read_back,
                             vk::BufferUsageFlagBits::eTransferDst);
        device_->run([&](const Device::Commands& commands) {
            commands.copyBuffer(handle(), staging.handle(), vk::BufferCopy(0, 0, bytes.size()));
        });
        staging.read_bytes(bytes);
        return;
    }
    guarded(name_of(*device_, size_) + " that is read", [&] {
        std::memcpy(bytes.data(), memory_.mapMemory(0, bytes.size()), bytes.size());
        memory_.unmapMemory();
    });
}

} // namespace nusselt::gpu
