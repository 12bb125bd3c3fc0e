#pragma once
/// Storage buffers.

#include "gpu/device.h"

#include <cstddef>
#include <span>

namespace nusselt::gpu {

/// Where a buffer lives.
enum class Residence {
    host_visible, ///< memory that both sides see: for what is written or read once
    device_local, ///< the fastest memory of the device; read() and write() copy through a buffer in between
};

class Buffer {
public:
    /// \param bytes size, positive.
    /// \throws Error if the device has no memory for it or no storage buffers as large.
    Buffer(const Device& device, std::size_t bytes, Residence residence);

    std::size_t size() const { return size_; }
    vk::Buffer handle() const { return *buffer_; }

    /// Overwrites the beginning. \param values at most as large as the buffer.
    template <class T>
    void write(std::span<const T> values) {
        write_bytes(std::as_bytes(values));
    }
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
