#include "scene/build/textures/texture_image.h"

#include "image/codecs.h"
#include "image/coded_file.h"
#include "image/io.h"
#include "image/srgb.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
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

bool begins_like_hdr(std::istream& file) {
    const bool begins = file.get() == '#' && file.get() == '?';
    file.clear();
    file.seekg(0);
    return begins;
}

void decode_contents(std::istream& file, ImageRequest::Encoding encoding, Budget& texels, Texture& texture) {
    if (begins_like_hdr(file)) {
        take_image(image::decode_hdr(file), texture);
        charge(texture, texels);
        return;
    }
    const image::CodedHeader header = image::read_coded_header(file);
    texture.width = header.width;
    texture.height = header.height;
    charge(texture, texels);
    // No texture has two channels, so grey with alpha becomes colour with alpha.
    const int channels = header.channels == 2 ? 4 : header.channels;
    image::Texels decoded = image::decode_codes(file, channels, [&](double code) {
        return encoding == ImageRequest::kSrgb ? image::linear_from_srgb(code) : std::pow(code, encoding);
    });
    texture.channels = decoded.channels;
    texture.texels = std::move(decoded.values);
}

bool is_read_by_extension(const std::filesystem::path& path) {
    const std::string extension = image::lower_case_extension(path);
    return extension == ".exr" || extension == ".pfm";
}

/// The path in a form that is the same for all ways to write it, if there is one.
std::string whole_path(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(path, error);
    return (error ? path : whole).string();
}

} // namespace

Texture decode_image(const ImageRequest& request, SceneBudget& budget, Warnings& warnings) {
    Texture texture;
    texture.name = request.path.filename().string();
    texture.path = whole_path(request.path);
    try {
        if (is_read_by_extension(request.path)) {
            take_image(image::read_image(request.path), texture);
            charge(texture, budget.texels);
        } else {
            decode_contents(*open_contents(request.path, budget.inflated_bytes), request.encoding,
                            budget.texels, texture);
        }
        turn_over(texture);
    } catch (const std::runtime_error& error) {
        const std::string path = "'" + request.path.string() + "': ";
        std::string_view problem = error.what();
        // Readers of images name the file, too.
        if (const std::string named = "cannot read " + path; problem.starts_with(named))
            problem.remove_prefix(named.size());
        throw SceneError(request.location, "texture file " + path + std::string(problem));
    }
    remove_invalid(request, texture, warnings);
    return texture;
}

} // namespace nusselt::scene
