#include "scene/build/textures/texture_image.h"

#include "image/codecs.h"
#include "image/coded_file.h"
#include "image/io.h"
#include "image/srgb.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

namespace nusselt::scene {

namespace {

/// Row 0 of textures is the lowest one.
void turn_over(Texture& texture) {
    const std::size_t row = texture.texels.size() / static_cast<std::size_t>(texture.height);
    auto low = texture.texels.begin();
    for (auto high = texture.texels.end(); low + static_cast<std::ptrdiff_t>(row) < high;
         low += static_cast<std::ptrdiff_t>(row)) {
        high -= static_cast<std::ptrdiff_t>(row);
        std::swap_ranges(low, low + static_cast<std::ptrdiff_t>(row), high);
    }
}

void take_image(image::Image&& pixels, Texture& texture) {
    texture.width = pixels.width;
    texture.height = pixels.height;
    texture.texels = std::move(pixels.pixels);
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
                                           " negative or non-finite numbers are replaced by 0");
}

void charge(const Texture& texture, Budget& texels) {
    texels.take(static_cast<std::uint64_t>(texture.width) * static_cast<std::uint64_t>(texture.height));
}

void decode_bytes(std::string_view file, ImageRequest::Encoding encoding, Budget& texels, Texture& texture) {
    if (file.starts_with("#?")) {
        std::istringstream stream{std::string(file)};
        take_image(image::decode_hdr(stream), texture);
        charge(texture, texels);
        return;
    }
    const image::CodedHeader header = image::read_coded_header(file);
    texture.width = header.width;
    texture.height = header.height;
    charge(texture, texels);
    // No texture has two channels, so grey with alpha becomes colour with alpha.
    texture.channels = header.channels == 2 ? 4 : header.channels;
    texture.texels = image::decode_codes(file, texture.channels, [&](double code) {
        return encoding == ImageRequest::kSrgb ? image::linear_from_srgb(code) : std::pow(code, encoding);
    });
    drop_opaque_alpha(texture);
}

bool is_read_by_extension(const std::filesystem::path& path) {
    const std::string extension = image::lower_case_extension(path);
    return extension == ".exr" || extension == ".pfm";
}

} // namespace

Texture decode_image(const ImageRequest& request, SceneBudget& budget, Warnings& warnings) {
    Texture texture;
    texture.name = request.path.filename().string();
    try {
        if (is_read_by_extension(request.path)) {
            take_image(image::read_image(request.path), texture);
            charge(texture, budget.texels);
        } else {
            decode_bytes(FileBytes(request.path, budget.inflated_bytes).view(), request.encoding,
                         budget.texels, texture);
        }
        turn_over(texture);
    } catch (const std::runtime_error& error) {
        throw SceneError(request.location, "texture file '" + request.path.string() + "': " + error.what());
    }
    remove_invalid(request, texture, warnings);
    return texture;
}

} // namespace nusselt::scene
