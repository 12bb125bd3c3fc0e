#pragma once
/// The textures of a scene on a device.

#include "gpu/buffer.h"
#include "gpu/image_array.h"
#include "scene/model/scene.h"

#include <optional>
#include <span>
#include <string_view>

namespace nusselt::render_vulkan {

/// Where shaders read texels.
enum class TextureAccess {
    images, ///< an image for each texture, on devices where shaders choose from images
    buffer, ///< one buffer for all, which the device limits
};

std::string_view name_of(TextureAccess access);

/// Both ways keep all bits of all texels, in as few as that takes: see TextureCodes.
class SceneTextures {
public:
    /// \param device   must outlive this.
    /// \param textures of the scene; not referred to afterwards.
    /// \param access   without it: images where the device has what that takes, else the buffer.
    /// \throws gpu::Error if the device does not have what `access` takes, or not enough memory.
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
