#include "scene/texture_image.h"

#include "image/io.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <memory>
#include <stb/stb_image.h>
#include <string>

namespace nusselt::scene {

namespace {

/// Deflate, the densest of the compressions, makes at most 1032 bytes of one, and a byte of PNG may be eight texels.
/// Files with more texels than this per byte are damaged or hostile; small images may be anything.
constexpr std::int64_t kTexelsPerByte = 2048;
constexpr std::int64_t kAlwaysAllowedTexels = std::int64_t{1} << 20;

void check_size(const Texture& texture, std::int64_t file_size) {
    const std::int64_t count = std::int64_t{texture.width} * texture.height;
    const std::int64_t limit = std::min(kMaxImageTexels, kAlwaysAllowedTexels + kTexelsPerByte * file_size);
    if (count > limit)
        throw std::runtime_error("a file of " + std::to_string(file_size) + " bytes claims " +
                                 std::to_string(texture.width) + " x " + std::to_string(texture.height) +
                                 " pixels, more than the " + std::to_string(limit) +
                                 " that are allowed; it is damaged or must be made smaller");
}

/// Decodes the entries of all rows, the last row first.
/// \param decode  function of an entry and its channel
template <class Source, class Decode>
void fill_flipped(const Source* source, Texture& texture, const Decode& decode) {
    const auto channels = static_cast<std::size_t>(texture.channels);
    const std::size_t row = channels * static_cast<std::size_t>(texture.width);
    const std::size_t size = row * static_cast<std::size_t>(texture.height);
    texture.texels.resize(size);
    for (std::size_t begin = 0; begin < size; begin += row) {
        float* target = texture.texels.data() + (size - row - begin);
        for (std::size_t i = 0; i < row; i += channels)
            for (std::size_t c = 0; c < channels; ++c) target[i + c] = decode(source[begin + i + c], c);
    }
}

template <class Value>
using StbPixels = std::unique_ptr<Value, void (*)(void*)>;

template <class Value>
StbPixels<Value> owned(Value* pixels) {
    if (pixels == nullptr)
        throw std::runtime_error(std::string("cannot be decoded (") + stbi_failure_reason() +
                                 "); is it complete?");
    return {pixels, stbi_image_free};
}

template <class Code>
void fill_linear(const StbPixels<Code>& codes, ImageRequest::Encoding encoding, Texture& texture) {
    constexpr std::size_t kLargest = std::numeric_limits<Code>::max();
    std::vector<float> linear(kLargest + 1);
    for (std::size_t i = 0; i <= kLargest; ++i) {
        const double x = static_cast<double>(i) / kLargest;
        const double srgb = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
        linear[i] = static_cast<float>(encoding == ImageRequest::kSrgb ? srgb : std::pow(x, encoding));
    }
    fill_flipped(codes.get(), texture, [&](Code code, std::size_t channel) {
        return channel == 3 ? static_cast<float>(code) / kLargest : linear[code];
    });
}

void drop_opaque_alpha(Texture& texture) {
    std::vector<float>& texels = texture.texels;
    if (texture.channels != 4) return;
    for (std::size_t i = 3; i < texels.size(); i += 4)
        if (texels[i] != 1) return;
    std::size_t end = 0;
    for (std::size_t i = 0; i < texels.size(); ++i)
        if (i % 4 != 3) texels[end++] = texels[i];
    texels.resize(end);
    texels.shrink_to_fit();
    texture.channels = 3;
}

void remove_invalid(const ImageRequest& request, Texture& texture, Warnings& warnings) {
    std::size_t count = 0;
    for (float& value : texture.texels) {
        if (value >= 0 && value <= std::numeric_limits<float>::max()) continue;
        value = 0;
        ++count;
    }
    if (count > 0)
        warnings.add(request.location, "texture file '" + request.path.string() +
                                           "': " + std::to_string(count) +
                                           " numbers that are negative or not finite are replaced by 0");
}

void charge(const Texture& texture, Budget& texels) {
    texels.take(static_cast<std::uint64_t>(texture.width) * static_cast<std::uint64_t>(texture.height));
}

/// The formats of stb.
void decode_bytes(std::string_view file, ImageRequest::Encoding encoding, Budget& texels, Texture& texture) {
    const auto* bytes = reinterpret_cast<const stbi_uc*>(file.data());
    if (file.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw std::runtime_error("larger than 2 GiB");
    const int size = static_cast<int>(file.size());
    int* const width = &texture.width;
    int* const height = &texture.height;
    int in_file = 0;
    if (stbi_info_from_memory(bytes, size, width, height, &in_file) == 0)
        throw std::runtime_error(
            std::string("it is damaged, too large or none of PNG, JPEG, TGA, BMP, HDR, EXR and PFM (") +
            stbi_failure_reason() + ')');
    check_size(texture, size);
    charge(texture, texels);
    if (stbi_is_hdr_from_memory(bytes, size) != 0) {
        const auto pixels = owned(stbi_loadf_from_memory(bytes, size, width, height, &in_file, 3));
        fill_flipped(pixels.get(), texture, [](float value, std::size_t) { return value; });
        return;
    }
    // Grey with alpha becomes colour with alpha.
    const int channels = texture.channels = in_file == 2 ? 4 : in_file;
    if (stbi_is_16_bit_from_memory(bytes, size) != 0)
        fill_linear(owned(stbi_load_16_from_memory(bytes, size, width, height, &in_file, channels)), encoding,
                    texture);
    else
        fill_linear(owned(stbi_load_from_memory(bytes, size, width, height, &in_file, channels)), encoding,
                    texture);
    drop_opaque_alpha(texture);
}

bool is_read_by_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".exr" || extension == ".pfm";
}

} // namespace

Texture decode_image(const ImageRequest& request, SceneBudget& budget, Warnings& warnings) {
    Texture texture;
    texture.name = request.path.filename().string();
    try {
        if (is_read_by_extension(request.path)) {
            const image::Image pixels = image::read_image(request.path);
            texture.width = pixels.width;
            texture.height = pixels.height;
            charge(texture, budget.texels);
            fill_flipped(pixels.pixels.data(), texture, [](float value, std::size_t) { return value; });
        } else {
            decode_bytes(FileBytes(request.path, budget.inflated_bytes).view(), request.encoding,
                         budget.texels, texture);
        }
    } catch (const std::runtime_error& error) {
        throw SceneError(request.location, "texture file '" + request.path.string() + "': " + error.what());
    }
    remove_invalid(request, texture, warnings);
    return texture;
}

} // namespace nusselt::scene
