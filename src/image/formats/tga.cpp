#include "image/formats/tga.h"

#include "image/formats/bytes.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

namespace nusselt::image {

namespace {

constexpr std::size_t kHeaderSize = 18;

/// The format of stored pixels or of the entries of a palette.
enum class Layout { unknown, grey, grey_alpha, rgb555, bgr, bgra };

Layout layout_of(std::uint32_t bits, bool is_grey) {
    switch (bits) {
    case 8:
        return Layout::grey;
    case 15:
        return Layout::rgb555;
    case 16:
        return is_grey ? Layout::grey_alpha : Layout::rgb555;
    case 24:
        return Layout::bgr;
    case 32:
        return Layout::bgra;
    default:
        return Layout::unknown;
    }
}

int channels_of(Layout layout) {
    return layout == Layout::grey ? 1 : layout == Layout::grey_alpha ? 2 : layout == Layout::bgra ? 4 : 3;
}

using Codes = std::array<std::uint8_t, 4>;

Codes decode_pixel(Layout layout, std::string_view bytes) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
    switch (layout) {
    case Layout::grey:
        return {byte(0)};
    case Layout::grey_alpha:
        return {byte(0), byte(1)};
    case Layout::rgb555: {
        const std::uint32_t value = little_endian(bytes, 0, 2);
        const auto code = [&](int shift) {
            return static_cast<std::uint8_t>((value >> shift & 31) * 255 / 31);
        };
        return {code(10), code(5), code(0)};
    }
    case Layout::bgra:
        return {byte(2), byte(1), byte(0), byte(3)};
    default:
        return {byte(2), byte(1), byte(0)};
    }
}

struct TgaHeader {
    explicit TgaHeader(std::string_view file);

    bool is_valid() const {
        return width > 0 && height > 0 && layout != Layout::unknown &&
               (has_palette ? type == 1 && (pixel_bits == 8 || pixel_bits == 16) : type == 2 || type == 3);
    }

    bool has_palette;
    bool has_runs;
    bool is_top_first;
    std::uint32_t type; ///< 1 with a palette, 2 colour, 3 grey
    std::uint32_t pixel_bits;
    std::size_t palette_length;
    std::size_t palette_entry_bytes;
    std::size_t pixel_bytes;
    int width;
    int height;
    Layout layout; ///< of colours, be they in the palette
    std::size_t palette_begin;
    std::size_t pixels_begin;
};

TgaHeader::TgaHeader(std::string_view file) {
    const auto field = [&](std::size_t begin, std::size_t size) { return little_endian(file, begin, size); };
    constexpr std::uint32_t kRuns = 8;
    const std::uint32_t palette_bits = field(7, 1);
    has_palette = field(1, 1) == 1;
    has_runs = field(2, 1) >= kRuns;
    type = field(1, 1) <= 1 ? field(2, 1) - (has_runs ? kRuns : 0) : 0;
    palette_length = field(5, 2);
    palette_entry_bytes = (palette_bits + 7) / 8;
    width = static_cast<int>(field(12, 2));
    height = static_cast<int>(field(14, 2));
    pixel_bits = field(16, 1);
    pixel_bytes = (pixel_bits + 7) / 8;
    is_top_first = (field(17, 1) & 0x20) != 0;
    layout = has_palette ? layout_of(palette_bits, false) : layout_of(pixel_bits, type == 3);
    palette_begin = kHeaderSize + field(0, 1);
    pixels_begin = palette_begin + (has_palette ? palette_length * palette_entry_bytes : 0);
}

std::vector<Codes> read_palette(std::string_view file, const TgaHeader& header) {
    if (header.palette_length == 0) throw std::runtime_error("the palette of this TGA file is empty");
    if (header.pixels_begin > file.size()) fail_as_cut_off();
    std::vector<Codes> palette(header.palette_length);
    for (std::size_t i = 0; i < palette.size(); ++i)
        palette[i] =
            decode_pixel(header.layout, file.substr(header.palette_begin + i * header.palette_entry_bytes,
                                                    header.palette_entry_bytes));
    return palette;
}

/// The pixels in the order of the file.
class TgaPixels {
public:
    TgaPixels(std::string_view file, const TgaHeader& header)
        : header_(header), rest_(file.substr(std::min(header.pixels_begin, file.size()))) {
        if (header.has_palette) palette_ = read_palette(file, header);
    }

    Codes next() {
        if (!header_.has_runs) return read_pixel();
        if (left_in_packet_ == 0) {
            const auto packet = static_cast<std::uint8_t>(take(1)[0]);
            left_in_packet_ = packet % 128u + 1;
            repeats_ = packet >= 128;
            if (repeats_) pixel_ = read_pixel();
        }
        --left_in_packet_;
        return repeats_ ? pixel_ : read_pixel();
    }

private:
    std::string_view take(std::size_t count) {
        if (count > rest_.size()) fail_as_cut_off();
        const std::string_view bytes = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return bytes;
    }

    Codes read_pixel() {
        const std::string_view bytes = take(header_.pixel_bytes);
        if (!header_.has_palette) return decode_pixel(header_.layout, bytes);
        // As other programs do, numbers beyond the palette stand for its first colour.
        const std::size_t number = little_endian(bytes, 0, bytes.size());
        return palette_[number < palette_.size() ? number : 0];
    }

    const TgaHeader& header_;
    std::vector<Codes> palette_;
    std::string_view rest_;
    std::size_t left_in_packet_ = 0;
    bool repeats_ = false;
    Codes pixel_ = {};
};

} // namespace

bool is_tga(std::string_view file) { return file.size() > kHeaderSize && TgaHeader(file).is_valid(); }

CodedHeader read_tga_header(std::string_view file) {
    const TgaHeader tga(file);
    const CodedHeader header = {tga.width, tga.height, channels_of(tga.layout), 8};
    // A packet has up to 128 pixels.
    const double pixel_bytes = static_cast<double>(tga.pixel_bytes);
    check_claims(file, header, tga.has_runs ? 128 / (1 + pixel_bytes) : 1 / pixel_bytes);
    return header;
}

void decode_tga(std::string_view file, CodeRows& rows) {
    const TgaHeader header(file);
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    const auto channels = static_cast<std::size_t>(channels_of(header.layout));
    TgaPixels pixels(file, header);
    std::vector<std::uint8_t> row(width * channels);
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            const Codes codes = pixels.next();
            std::copy_n(codes.begin(), channels, row.begin() + static_cast<std::ptrdiff_t>(x * channels));
        }
        rows.put(row.data(), width, {.y = header.is_top_first ? y : height - 1 - y});
    }
}

} // namespace nusselt::image
