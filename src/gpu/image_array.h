#pragma once
/// Images that shaders choose from by number. Only on devices with DeviceFeatures::indexed_images.

#include "gpu/buffer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nusselt::gpu {

struct ImageDescription {
    vk::Format format;           ///< one that all devices sample
    std::uint32_t texel_bytes;   ///< of that format
    std::uint32_t width, height; ///< positive
};

/// Images of two dimensions without further levels, immutable: an array of sampled images, which is binding 0 of set 1 of
/// compute and fragment shaders.
class ImageArray {
public:
    /// The reason for which the constructor would throw, apart from memory; nothing if it would not.
    static std::optional<std::string> why_impossible(const Device& device,
                                                     std::span<const ImageDescription> images);

    /// \param images at least one.
    /// \param texels called once for each image, in turn, with its number: the texels, row by row.
    /// \throws Error if the device cannot index images, if they are too many or too large for it, or if memory runs
    ///         out.
    ImageArray(const Device& device, std::span<const ImageDescription> images,
               const std::function<std::vector<std::byte>(std::size_t)>& texels);

    std::size_t count() const { return images_.size(); }
    vk::DescriptorSetLayout layout() const { return *layout_; }
    vk::DescriptorSet handle() const { return set_; }

private:
    void make_images(const Device& device, std::span<const ImageDescription> images);
    void write(const Device& device, std::span<const ImageDescription> images,
               const std::function<std::vector<std::byte>(std::size_t)>& texels) const;
    void make_set(const Device& device, std::span<const ImageDescription> images);

    std::vector<vk::raii::Image> images_;
    std::vector<vk::raii::DeviceMemory> memory_; ///< freed before the images, which Vulkan allows
    std::vector<vk::raii::ImageView> views_;
    vk::raii::DescriptorSetLayout layout_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::DescriptorSet set_; ///< freed with its pool
};

} // namespace nusselt::gpu
