#pragma once
/// An RGB image in memory, the meeting point of renderers, files and metrics.

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace nusselt::image {

/// Linear RGB, three floats per pixel. Row 0 is the top row. Infinities and NaN are legal contents.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<float>
        pixels; ///< 3 * width * height floats: r, g, b of the pixel (x, y) from 3 * (y * width + x)
};

/// Larger images are taken for damaged or hostile files: 2^28 pixels are 3 GiB of floats.
inline constexpr std::int64_t kMaxPixelCount = std::int64_t(1) << 28;

/// \throws std::runtime_error  with the size, the memory that it would take and the limit, unless the size is positive
///                             and at most kMaxPixelCount
void check_size(std::int64_t width, std::int64_t height);

/// An image of the given size, all zero. Both sizes must be positive.
inline Image make_image(int width, int height) {
    const std::size_t float_count = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {width, height, std::vector<float>(float_count)};
}

/// Settings that travel with an image: keys and values are free text.
using Metadata = std::map<std::string, std::string>;

/// Metadata of images whose pixels are not those of the rendering that the other metadata describe.
inline constexpr const char* kConvertedKey = "converted";

/// The shortest text that gives the same number when it is read as a `Float`: different numbers have different texts.
template <class Float>
std::string metadata_text(Float value) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

} // namespace nusselt::image
