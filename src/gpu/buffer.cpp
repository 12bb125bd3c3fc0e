#include "gpu/buffer.h"

#include <cassert>
#include <cstring>

namespace nusselt::gpu {

namespace {

vk::raii::Buffer make_buffer(const Device& device, std::size_t bytes) {
    assert(bytes > 0);
    if (bytes > device.limits().maxStorageBufferRange)
        throw Error(device.description().name + ": a buffer of " + std::to_string(bytes >> 20) +
                    " MiB is too large, the limit is " +
                    std::to_string(device.limits().maxStorageBufferRange >> 20) + " MiB; ask for less");
    using Usage = vk::BufferUsageFlagBits;
    const vk::BufferCreateInfo info({}, bytes,
                                    Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst);
    return guarded(device.description().name, [&] { return vk::raii::Buffer(device.handle(), info); });
}

vk::MemoryPropertyFlags properties_of(Residence residence) {
    using Property = vk::MemoryPropertyFlagBits;
    if (residence == Residence::device_local) return Property::eDeviceLocal;
    return Property::eHostVisible | Property::eHostCoherent;
}

} // namespace

Buffer::Buffer(const Device& device, std::size_t bytes, Residence residence)
    : device_(&device),
      size_(bytes),
      residence_(residence),
      buffer_(make_buffer(device, bytes)),
      memory_(device.allocate(buffer_.getMemoryRequirements(), properties_of(residence))) {
    guarded(device.description().name, [&] { buffer_.bindMemory(*memory_, 0); });
}

void Buffer::write_bytes(std::span<const std::byte> bytes) {
    assert(bytes.size() <= size_);
    if (residence_ == Residence::device_local) {
        Buffer staging(*device_, bytes.size(), Residence::host_visible);
        staging.write_bytes(bytes);
        device_->run([&](const Device::Commands& commands) {
            commands.copyBuffer(staging.handle(), handle(), vk::BufferCopy(0, 0, bytes.size()));
        });
        return;
    }
    guarded(device_->description().name, [&] {
        std::memcpy(memory_.mapMemory(0, bytes.size()), bytes.data(), bytes.size());
        memory_.unmapMemory();
    });
}

void Buffer::read_bytes(std::span<std::byte> bytes) const {
    assert(bytes.size() <= size_);
    if (residence_ == Residence::device_local) {
        const Buffer staging(*device_, bytes.size(), Residence::host_visible);
        device_->run([&](const Device::Commands& commands) {
            commands.copyBuffer(handle(), staging.handle(), vk::BufferCopy(0, 0, bytes.size()));
        });
        staging.read_bytes(bytes);
        return;
    }
    guarded(device_->description().name, [&] {
        std::memcpy(bytes.data(), memory_.mapMemory(0, bytes.size()), bytes.size());
        memory_.unmapMemory();
    });
}

} // namespace nusselt::gpu
