#pragma once
/// Drawing triangles whose numbers are what is drawn.

#include "gpu/shader_bindings.h"
#include "gpu/shader_cache.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nusselt::gpu {

/// The inputs of the shaders of a RasterPass.
struct RasterInterface {
    std::uint32_t storage_buffers = 0;    ///< bindings 0 to this, exclusive, of set 0, in both stages
    const ImageArray* images = nullptr;   ///< set 1, or none; must outlive the pass
    std::uint32_t push_constant_size = 0; ///< [bytes], in both stages
    std::vector<std::uint32_t> constants =
        {}; ///< specialisation constants 0, 1, ... of both stages: the bits of each
};

/// Draws triangles, either side, into an image with one 32-bit integer per pixel. There is no vertex input: shaders
/// get vertices from storage buffers. Larger depths are nearer: of all triangles with a depth between 0 and 1, the
/// pixel gets what the one with the largest writes, and 0 where there is none. The shaders are compiled once per device,
/// whichever passes of whatever size ask for them.
class RasterPass {
public:
    /// \param vertex, fragment shaders with the entry point `main`; the fragment shader writes a uint to location 0.
    /// \param width, height of the image, positive.
    /// \throws Error if the device has no queue for drawing or no images as large, if the driver cannot compile the
    ///         shaders, or if memory runs out.
    RasterPass(const Device& device, std::span<const std::uint32_t> vertex,
               std::span<const std::uint32_t> fragment, const RasterInterface& interface, std::uint32_t width,
               std::uint32_t height);

    /// \copydoc ShaderBindings::bind
    void bind(std::span<const Buffer* const> buffers) { bindings_.bind(buffers); }

    /// Records drawing, and a copy of the image to a buffer, row by row from the top.
    /// \param push     the push constants, exactly as large as the interface says.
    /// \param vertices three for each triangle; may be 0.
    /// \param numbers  one uint per pixel.
    void draw(const Device::Commands& commands, std::span<const std::byte> push, std::uint32_t vertices,
              const Buffer& numbers) const;

private:
    /// An image of the size of the pass.
    struct Target {
        Target(const Device& device, vk::Format format, vk::ImageUsageFlags usage,
               vk::ImageAspectFlags aspect, vk::Extent2D size);

        vk::raii::Image image;
        vk::raii::DeviceMemory memory;
        vk::raii::ImageView view;
    };

    std::uint32_t push_constant_size_;
    vk::Extent2D size_;
    Target numbers_, depth_;
    vk::raii::RenderPass render_pass_;
    vk::raii::Framebuffer framebuffer_;
    ShaderBindings bindings_;
    const CompiledShader* shader_; ///< lives as long as the device
};

} // namespace nusselt::gpu
