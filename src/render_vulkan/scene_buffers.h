#pragma once
/// The buffers of a scene.

#include "gpu/buffer.h"
#include "render_vulkan/scene_records.h"

#include <algorithm>
#include <span>
#include <vector>

namespace nusselt::render_vulkan {

/// A buffer with these values. It has room for one value if there are none, since buffers cannot be empty.
/// \param what the values are, for messages
/// \throws gpu::Error if the device has no memory for them, or limits buffers to a smaller size
template <class T>
gpu::Buffer upload(const gpu::Device& device, std::span<const T> values, const char* what);

/// The buffers of shaders/passes/scene.glsl and shaders/passes/lights, without those of textures.
struct SceneBuffers {
    /// \throws gpu::Error as upload() does
    SceneBuffers(const gpu::Device& device, const SceneRecords& records);

    gpu::Buffer scene, vertices, triangles, instances, materials;
    std::vector<gpu::Buffer> lights; ///< by binding, from interface::kFirstLightBinding on
};

template <class T>
gpu::Buffer upload(const gpu::Device& device, std::span<const T> values, const char* what) {
    const std::size_t bytes = std::max(values.size_bytes(), sizeof(T));
    if (bytes > device.limits().maxStorageBufferRange)
        throw gpu::Error(device.description().name + ": the " + what + " of the scene take " +
                         gpu::size_text(bytes) + ", but buffers of this device are limited to " +
                         gpu::size_text(device.limits().maxStorageBufferRange) +
                         "; use another device or --backend cpu");
    gpu::Buffer buffer(device, bytes, gpu::Residence::device_local);
    if (!values.empty()) buffer.write(values);
    return buffer;
}

} // namespace nusselt::render_vulkan
