#pragma once
/// Storage buffers.

#include "gpu/device.h"

#include <cstddef>
#include <span>

namespace nusselt::gpu {

/// Storage buffers of shaders.
inline constexpr vk::BufferUsageFlags kStorageUse = vk::BufferUsageFlagBits::eStorageBuffer |
                                                    vk::BufferUsageFlagBits::eTransferSrc |
                                                    vk::BufferUsageFlagBits::eTransferDst;

/// The memory of a buffer.
enum class Residence {
    host_visible, ///< memory that both sides see: for what is written or read once
    read_back,    ///< likewise, for what the host reads often: in its caches if the device has such memory
    device_local, ///< the fastest memory of the device; read() and write() copy through a buffer in between
};

class Buffer {
public:
    /// \param bytes size, positive.
    /// \param use   what shaders and commands do with it.
    /// \throws Error if the device has no memory for it or no storage buffers as large.
    Buffer(const Device& device, std::size_t bytes, Residence residence,
           vk::BufferUsageFlags use = kStorageUse);

    std::size_t size() const { return size_; }
    vk::Buffer handle() const { return *buffer_; }
    /// The address of the first byte on the device. Requires the use eShaderDeviceAddress.
    vk::DeviceAddress address() const;

    /// Overwrites the beginning. \param values at most as large as the buffer.
    template <class T>
    void write(std::span<const T> values) {
        write_bytes(std::as_bytes(values));
    }
    /// Overwrites all of it.
    void fill_with_zeros();
    /// Reads the beginning. \param values at most as large as the buffer.
    template <class T>
    void read(std::span<T> values) const {
        read_bytes(std::as_writable_bytes(values));
    }

private:
    void write_bytes(std::span<const std::byte> bytes);
    void read_bytes(std::span<std::byte> bytes) const;

    const Device* device_;
    std::size_t size_;
    Residence residence_;
    vk::raii::Buffer buffer_;
    vk::raii::DeviceMemory memory_; ///< freed first, which Vulkan allows
};

} // namespace nusselt::gpu
