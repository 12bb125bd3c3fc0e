#include "render_vulkan/scene_textures.h"

#include "interface/scene.h"
#include "render_vulkan/scene_buffers.h"
#include "render_vulkan/texture_codes.h"

#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace nusselt::render_vulkan {

namespace {

using Codes = std::vector<TextureCodes>;

/// Images have one or four channels: not all devices support other numbers.
int image_channels(const scene::Texture& texture) { return texture.channels == 1 ? 1 : 4; }

vk::Format image_format(int channels, std::uint32_t packing) {
    constexpr vk::Format kGrey[] = {vk::Format::eR32Uint, vk::Format::eR16Uint, vk::Format::eR8Uint};
    constexpr vk::Format kColour[] = {vk::Format::eR32G32B32A32Uint, vk::Format::eR16G16B16A16Uint,
                                      vk::Format::eR8G8B8A8Uint};
    return channels == 1 ? kGrey[packing] : kColour[packing];
}

std::vector<gpu::ImageDescription> describe(std::span<const scene::Texture> textures, const Codes& codes) {
    std::vector<gpu::ImageDescription> images;
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const int channels = image_channels(textures[i]);
        images.push_back({image_format(channels, codes[i].packing),
                          static_cast<std::uint32_t>(channels) * (4u >> codes[i].packing),
                          static_cast<std::uint32_t>(textures[i].width),
                          static_cast<std::uint32_t>(textures[i].height)});
    }
    return images;
}

/// The reason why texels cannot be in images; empty if they can.
std::optional<std::string> why_no_images(const gpu::Device& device,
                                         std::span<const gpu::ImageDescription> images) {
    if (images.empty()) return "the scene has no textures";
    return gpu::ImageArray::why_impossible(device, images);
}

std::uint32_t wrap_of(scene::TextureWrap wrap) {
    switch (wrap) {
    case scene::TextureWrap::clamp:
        return interface::kWrapClamp;
    case scene::TextureWrap::black:
        return interface::kWrapBlack;
    case scene::TextureWrap::repeat:
        break;
    }
    return interface::kWrapRepeat;
}

/// Appends bytes to words, padded up to the next word.
/// \returns the index of their first word
std::uint32_t append(std::span<const std::byte> bytes, std::vector<std::uint32_t>& words) {
    const std::size_t first = words.size();
    words.resize(first + (bytes.size() + sizeof(std::uint32_t) - 1) / sizeof(std::uint32_t));
    if (words.size() > std::numeric_limits<std::uint32_t>::max())
        throw std::runtime_error(
            "the textures of the scene exceed the limit of 2^32 words on GPUs; use --backend cpu");
    if (!bytes.empty()) std::memcpy(words.data() + first, bytes.data(), bytes.size());
    return static_cast<std::uint32_t>(first);
}

} // namespace

std::string_view name_of(TextureAccess access) {
    return access == TextureAccess::images ? "images" : "buffer";
}

SceneTextures::SceneTextures(const gpu::Device& device, std::span<const scene::Texture> textures,
                             std::optional<TextureAccess> access) {
    Codes codes;
    for (const scene::Texture& texture : textures) codes.push_back(encode_texels(texture.texels));
    if (access != TextureAccess::buffer) {
        const std::vector<gpu::ImageDescription> descriptions = describe(textures, codes);
        const auto reason = why_no_images(device, descriptions);
        if (reason && access == TextureAccess::images) throw gpu::Error(*reason);
        if (!reason)
            images_.emplace(device, descriptions, [&](std::size_t i) {
                return packed_codes(textures[i], codes[i], image_channels(textures[i]));
            });
    }
    std::vector<interface::TextureRecord> records;
    std::vector<std::uint32_t> words;
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const scene::Texture& texture = textures[i];
        interface::TextureRecord& record = records.emplace_back();
        record.first_value = append(std::as_bytes(std::span(codes[i].values)), words);
        if (!images_) record.first_code = append(packed_codes(texture, codes[i], texture.channels), words);
        record.packing = codes[i].packing;
        record.width = texture.width;
        record.height = texture.height;
        record.channels = texture.channels;
        record.wrap = wrap_of(texture.wrap);
        record.is_nearest = texture.filter == scene::TextureFilter::nearest ? 1 : 0;
    }
    records_.emplace(
        upload(device, std::span<const interface::TextureRecord>(records), "records of textures"));
    words_.emplace(upload(device, std::span<const std::uint32_t>(words), "texels"));
}

} // namespace nusselt::render_vulkan
