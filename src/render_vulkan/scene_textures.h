#pragma once
/// The textures of a scene on a device.

#include "gpu/buffer.h"
#include "gpu/image_array.h"
#include "scene/model/scene.h"

#include <optional>
#include <span>
#include <string_view>

namespace nusselt::render_vulkan {

/// Where shaders read texels from.
enum class TextureAccess {
    images, ///< an image for each texture, on devices whose shaders can index images
    buffer, ///< one buffer for all textures, whose size the device limits
};

std::string_view name_of(TextureAccess access);

/// Texels keep all their bits, in as little memory as that takes; see TextureCodes.
class SceneTextures {
public:
    /// \param device   must outlive this object
    /// \param textures of the scene; copied
    /// \param access   default: images where the device supports them, else the buffer
    /// \throws gpu::Error if the device does not support `access` or runs out of memory
    SceneTextures(const gpu::Device& device, std::span<const scene::Texture> textures,
                  std::optional<TextureAccess> access);

    TextureAccess access() const { return images_ ? TextureAccess::images : TextureAccess::buffer; }
    // For shaders/passes/scene.glsl.
    const gpu::Buffer& records() const { return *records_; }
    const gpu::Buffer& words() const { return *words_; } ///< values, and texels unless they are in images
    const gpu::ImageArray* images() const { return images_ ? &*images_ : nullptr; }

private:
    std::optional<gpu::ImageArray> images_;
    std::optional<gpu::Buffer> records_, words_;
};

} // namespace nusselt::render_vulkan
