/// Checks that stb leaves out: whether a file can hold the pixels that its header claims. stb allocates memory
/// for them first, and pixels of JPG and TGA files that are missing become black without an error.

#include "image/codecs.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace nusselt::image {

namespace {

[[noreturn]] void fail_as_cut_off() {
    throw std::runtime_error("the file is too small for its pixels; was it cut off?");
}

bool begins_with(const std::vector<char>& file, std::string_view text) {
    return file.size() >= text.size() && std::equal(text.begin(), text.end(), file.begin());
}

std::int64_t byte_at(const std::vector<char>& file, std::size_t i) {
    return i < file.size() ? static_cast<unsigned char>(file[i]) : 0;
}

/// Deflate makes at most 1032 bytes of one: 258 of two bits.
void check_png(const std::vector<char>& file, std::int64_t pixel_count) {
    constexpr std::size_t kDepth = 24; // signature, length and type of IHDR, width, height
    const std::int64_t color_type = byte_at(file, kDepth + 1);
    const std::int64_t channels = color_type == 2 ? 3 : color_type == 4 ? 2 : color_type == 6 ? 4 : 1;
    const std::int64_t bits = pixel_count * channels * byte_at(file, kDepth);
    if (bits / 8 / 1032 > std::int64_t(file.size())) fail_as_cut_off();
}

/// A block of 8 x 8 pixels takes one bit at least, so a byte makes up to 512 pixels, twice that with subsampled
/// channels. The end mark cannot occur in the data of pixels, though in a preview before them.
void check_jpg(const std::vector<char>& file, std::int64_t pixel_count) {
    constexpr std::string_view kEnd = "\xFF\xD9";
    if (pixel_count / 1024 > std::int64_t(file.size())) fail_as_cut_off();
    if (std::search(file.begin(), file.end(), kEnd.begin(), kEnd.end()) == file.end()) fail_as_cut_off();
}

/// Counts the pixels of a TGA file, run by run.
void check_tga(const std::vector<char>& file, std::int64_t pixel_count) {
    constexpr std::size_t kHeaderSize = 18;
    const std::int64_t palette_bytes =
        byte_at(file, 1) == 0 ? 0
                              : (byte_at(file, 5) + 256 * byte_at(file, 6)) * ((byte_at(file, 7) + 7) / 8);
    const std::int64_t pixel_bytes = (byte_at(file, 16) + 7) / 8;
    const std::int64_t begin = std::int64_t(kHeaderSize) + byte_at(file, 0) + palette_bytes;
    const std::int64_t size = std::int64_t(file.size());
    const bool has_runs = byte_at(file, 2) >= 8;
    if (!has_runs) {
        if (begin + pixel_count * pixel_bytes > size) fail_as_cut_off();
        return;
    }
    std::int64_t position = begin;
    for (std::int64_t pixels = 0; pixels < pixel_count;) {
        if (position >= size) fail_as_cut_off();
        const std::int64_t packet = byte_at(file, std::size_t(position));
        const std::int64_t count = packet % 128 + 1;
        pixels += count;
        position += 1 + pixel_bytes * (packet >= 128 ? 1 : count);
    }
    if (position > size) fail_as_cut_off();
}

} // namespace

void check_srgb_file(const std::vector<char>& file, std::int64_t width, std::int64_t height) {
    // stb knows further formats, which no one needs here. No TGA file begins like this.
    for (const std::string_view other : {"BM", "GIF8", "8BPS", "\x53\x80\xF6\x34", "P5", "P6", "#?"}) {
        if (begins_with(file, other))
            throw std::runtime_error("this is neither PNG, JPG nor TGA; check its name or convert it");
    }
    check_size(width, height);
    if (begins_with(file, "\x89PNG")) {
        check_png(file, width * height);
    } else if (begins_with(file, "\xFF\xD8")) {
        check_jpg(file, width * height);
    } else {
        check_tga(file, width * height);
    }
}

} // namespace nusselt::image
