#include "gpu/image_array.h"

#include <algorithm>
#include <cassert>

namespace nusselt::gpu {

namespace {

/// Drivers allow 4096 allocations, scenes have more textures: they share memory, in blocks of this size [bytes].
constexpr std::uint64_t kBlockSize = std::uint64_t{256} << 20;
/// The largest allocation that all devices support [bytes].
constexpr std::uint64_t kLargestImage = std::uint64_t{1} << 30;
/// The size of a copy, unless a single image is larger [bytes].
constexpr std::size_t kBatchSize = std::size_t{64} << 20;
/// A multiple of the size of all texels [bytes].
constexpr std::size_t kTexelAlignment = 16;

constexpr vk::ImageSubresourceRange kWhole(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);

std::uint64_t aligned(std::uint64_t x, std::uint64_t alignment) {
    return (x + alignment - 1) / alignment * alignment;
}

std::uint64_t bytes_of(const ImageDescription& image) {
    return std::uint64_t{image.texel_bytes} * image.width * image.height;
}

/// Images next to each other in memory.
struct Block {
    vk::MemoryRequirements requirements; ///< of all of them together
    std::vector<std::uint64_t> offsets;  ///< of each

    /// Adds an image unless it has no room or needs other memory.
    bool add(const vk::MemoryRequirements& image) {
        const std::uint64_t offset = aligned(requirements.size, image.alignment);
        const std::uint32_t types = requirements.memoryTypeBits & image.memoryTypeBits;
        if (!offsets.empty() && (offset + image.size > kBlockSize || types == 0)) return false;
        offsets.push_back(offset);
        requirements.size = offset + image.size;
        requirements.memoryTypeBits = offsets.size() == 1 ? image.memoryTypeBits : types;
        return true;
    }
};

vk::ImageMemoryBarrier transition(vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
    return {vk::AccessFlagBits::eMemoryWrite,
            vk::AccessFlagBits::eMemoryRead | vk::AccessFlagBits::eMemoryWrite,
            from,
            to,
            VK_QUEUE_FAMILY_IGNORED,
            VK_QUEUE_FAMILY_IGNORED,
            image,
            kWhole};
}

void transition_all(const Device::Commands& commands, std::span<const vk::raii::Image> images,
                    vk::ImageLayout from, vk::ImageLayout to) {
    std::vector<vk::ImageMemoryBarrier> barriers;
    for (const vk::raii::Image& image : images) barriers.push_back(transition(*image, from, to));
    const auto all = vk::PipelineStageFlagBits::eAllCommands;
    commands.pipelineBarrier(all, all, {}, {}, {}, barriers);
}

} // namespace

std::optional<std::string> ImageArray::why_impossible(const Device& device,
                                                      std::span<const ImageDescription> images) {
    const std::string& name = device.description().name;
    const std::uint32_t most = device.features().indexed_images;
    if (most == 0) return name + ": the device does not support arrays of images in shaders";
    if (images.size() > most)
        return name + ": shaders support at most " + std::to_string(most) + " images, found " +
               std::to_string(images.size());
    const std::uint32_t side = device.limits().maxImageDimension2D;
    for (const ImageDescription& image : images) {
        if (image.width <= side && image.height <= side && bytes_of(image) <= kLargestImage) continue;
        return name + ": an image of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
               " texels (" + size_text(bytes_of(image)) + ") exceeds the limit of " + std::to_string(side) +
               " x " + std::to_string(side) + " and " + size_text(kLargestImage);
    }
    return std::nullopt;
}

ImageArray::ImageArray(const Device& device, std::span<const ImageDescription> images,
                       const std::function<std::vector<std::byte>(std::size_t)>& texels) {
    assert(!images.empty());
    if (const auto reason = why_impossible(device, images)) throw Error(*reason);
    guarded(device.description().name + ": making " + std::to_string(images.size()) + " images", [&] {
        make_images(device, images);
        write(device, images, texels);
        make_set(device, images);
    });
}

void ImageArray::make_images(const Device& device, std::span<const ImageDescription> images) {
    std::vector<Block> blocks(1);
    for (const ImageDescription& image : images) {
        const vk::ImageCreateInfo info({}, vk::ImageType::e2D, image.format, {image.width, image.height, 1},
                                       1, 1, vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal,
                                       vk::ImageUsageFlagBits::eSampled |
                                           vk::ImageUsageFlagBits::eTransferDst);
        const vk::MemoryRequirements needed =
            images_.emplace_back(device.handle(), info).getMemoryRequirements();
        if (!blocks.back().add(needed)) blocks.emplace_back().add(needed);
    }
    std::size_t next = 0;
    for (const Block& block : blocks) {
        const vk::raii::DeviceMemory& memory = memory_.emplace_back(
            device.allocate(block.requirements, vk::MemoryPropertyFlagBits::eDeviceLocal));
        for (const std::uint64_t offset : block.offsets) images_[next++].bindMemory(*memory, offset);
    }
}

void ImageArray::write(const Device& device, std::span<const ImageDescription> images,
                       const std::function<std::vector<std::byte>(std::size_t)>& texels) const {
    for (std::size_t begin = 0; begin < images.size();) {
        std::vector<std::byte> staged;
        std::vector<std::size_t> offsets;
        std::size_t end = begin;
        while (end < images.size() && (end == begin || staged.size() + bytes_of(images[end]) <= kBatchSize)) {
            const std::vector<std::byte> added = texels(end);
            assert(added.size() == bytes_of(images[end]));
            offsets.push_back(staged.size());
            staged.insert(staged.end(), added.begin(), added.end());
            staged.resize(aligned(staged.size(), kTexelAlignment));
            ++end;
        }
        Buffer buffer(device, staged.size(), Residence::host_visible, vk::BufferUsageFlagBits::eTransferSrc);
        buffer.write(std::span<const std::byte>(staged));
        const auto batch = std::span(images_).subspan(begin, end - begin);
        device.run([&](const Device::Commands& commands) {
            using Layout = vk::ImageLayout;
            transition_all(commands, batch, Layout::eUndefined, Layout::eTransferDstOptimal);
            for (std::size_t i = 0; i < batch.size(); ++i) {
                const ImageDescription& image = images[begin + i];
                commands.copyBufferToImage(buffer.handle(), *batch[i], Layout::eTransferDstOptimal,
                                           vk::BufferImageCopy(offsets[i], 0, 0,
                                                               {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {},
                                                               {image.width, image.height, 1}));
            }
            transition_all(commands, batch, Layout::eTransferDstOptimal, Layout::eShaderReadOnlyOptimal);
        });
        begin = end;
    }
}

void ImageArray::make_set(const Device& device, std::span<const ImageDescription> images) {
    using Binding = vk::DescriptorBindingFlagBits;
    const auto count = static_cast<std::uint32_t>(images.size());
    const vk::DescriptorSetLayoutBinding binding(0, vk::DescriptorType::eSampledImage, count,
                                                 vk::ShaderStageFlagBits::eCompute |
                                                     vk::ShaderStageFlagBits::eFragment);
    // Not that it is ever updated after binding: devices allow far more descriptors that may be.
    const vk::DescriptorBindingFlags flags = Binding::eUpdateAfterBind;
    const vk::DescriptorSetLayoutBindingFlagsCreateInfo all_flags(flags);
    vk::DescriptorSetLayoutCreateInfo info(vk::DescriptorSetLayoutCreateFlagBits::eUpdateAfterBindPool,
                                           binding);
    info.pNext = &all_flags;
    layout_ = {device.handle(), info};
    const vk::DescriptorPoolSize size(vk::DescriptorType::eSampledImage, count);
    pool_ = {device.handle(),
             vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eUpdateAfterBind, 1, size)};
    set_ = vk::raii::DescriptorSets(device.handle(), {*pool_, *layout_}).front().release();
    std::vector<vk::DescriptorImageInfo> descriptors;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const vk::ImageViewCreateInfo view({}, *images_[i], vk::ImageViewType::e2D, images[i].format, {},
                                           kWhole);
        descriptors.emplace_back(nullptr, *views_.emplace_back(device.handle(), view),
                                 vk::ImageLayout::eShaderReadOnlyOptimal);
    }
    device.handle().updateDescriptorSets(
        vk::WriteDescriptorSet(set_, 0, 0, vk::DescriptorType::eSampledImage, descriptors), {});
}

} // namespace nusselt::gpu
