#include "image/formats/tga.h"

#include "image/formats/bytes.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
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
    /// \throws std::runtime_error  if the header makes no sense or tells of a kind that is not supported
    explicit TgaHeader(std::istream& file);

    bool has_palette;
    bool has_runs;
    bool is_top_first;
    bool is_right_first;
    std::size_t palette_length;
    std::size_t palette_entry_bytes;
    std::size_t pixel_bytes;
    int width;
    int height;
    Layout layout; ///< of colours, be they in the palette
    std::int64_t palette_begin;
    std::int64_t pixels_begin;
};

/// Files that are no TGA usually fail at the first checks.
[[noreturn]] void fail_as_no_tga(const std::string& problem) {
    throw std::runtime_error(
        "the file does not begin like PNG, JPG or BMP, and as TGA it is damaged or not supported: " +
        problem + "; check its name or convert it to PNG");
}

TgaHeader::TgaHeader(std::istream& file) {
    const std::string header = bytes_at(file, 0, kHeaderSize);
    const auto field = [&](std::size_t begin, std::size_t size) {
        return little_endian(header, begin, size);
    };
    if (header.size() < kHeaderSize)
        fail_as_no_tga("it has only " + std::to_string(header.size()) +
                       " bytes, but its header would have 18");
    constexpr std::uint32_t kPalette = 1, kGrey = 3, kRuns = 8;
    const std::uint32_t type = field(2, 1);
    has_runs = type >= kRuns;
    const std::uint32_t kind = type - (has_runs ? kRuns : 0);
    if (kind < kPalette || kind > kGrey)
        fail_as_no_tga(
            "its image type is " + std::to_string(type) +
            ", but must be 1, 2 or 3 (palette, colour or grey), or 9, 10 or 11 (the same with runs)");
    has_palette = kind == kPalette;
    if (field(1, 1) > 1 || (field(1, 1) == 1) != has_palette)
        fail_as_no_tga("its colour map type is " + std::to_string(field(1, 1)) + ", but must be " +
                       (has_palette ? "1" : "0") + " for the image type " + std::to_string(type));
    const std::uint32_t palette_bits = field(7, 1);
    const std::uint32_t pixel_bits = field(16, 1);
    palette_length = field(5, 2);
    palette_entry_bytes = (palette_bits + 7) / 8;
    width = static_cast<int>(field(12, 2));
    height = static_cast<int>(field(14, 2));
    if (width == 0 || height == 0)
        fail_as_no_tga("its size is " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
    pixel_bytes = (pixel_bits + 7) / 8;
    is_right_first = (field(17, 1) & 0x10) != 0;
    is_top_first = (field(17, 1) & 0x20) != 0;
    layout = has_palette ? layout_of(palette_bits, false) : layout_of(pixel_bits, kind == kGrey);
    if (layout == Layout::unknown)
        fail_as_no_tga((has_palette ? "its palette has " + std::to_string(palette_bits) + " bits per colour"
                                    : "it has " + std::to_string(pixel_bits) + " bits per pixel") +
                       "; 8, 15, 16, 24 and 32 are supported");
    if (has_palette && pixel_bits != 8 && pixel_bits != 16)
        fail_as_no_tga("its palette indices have " + std::to_string(pixel_bits) +
                       " bits; 8 and 16 are supported");
    palette_begin = static_cast<std::int64_t>(kHeaderSize + field(0, 1));
    pixels_begin =
        palette_begin + static_cast<std::int64_t>(has_palette ? palette_length * palette_entry_bytes : 0);
}

std::vector<Codes> read_palette(std::istream& file, const TgaHeader& header) {
    if (header.palette_length == 0)
        throw std::runtime_error("the palette of this TGA file is empty; the file is damaged");
    ByteSource source(file, header.palette_begin);
    std::vector<Codes> palette(header.palette_length);
    for (Codes& colour : palette)
        colour = decode_pixel(header.layout, source.take(header.palette_entry_bytes));
    return palette;
}

/// The pixels in the order of the file.
class TgaPixels {
public:
    TgaPixels(std::istream& file, const TgaHeader& header)
        : header_(header),
          palette_(header.has_palette ? read_palette(file, header) : std::vector<Codes>()),
          source_(file, header.pixels_begin) {}

    Codes next() {
        if (!header_.has_runs) return read_pixel();
        if (left_in_packet_ == 0) {
            const auto packet = static_cast<std::uint8_t>(source_.take(1)[0]);
            left_in_packet_ = packet % 128u + 1;
            repeats_ = packet >= 128;
            if (repeats_) pixel_ = read_pixel();
        }
        --left_in_packet_;
        return repeats_ ? pixel_ : read_pixel();
    }

private:
    Codes read_pixel() {
        const std::string_view bytes = source_.take(header_.pixel_bytes);
        if (!header_.has_palette) return decode_pixel(header_.layout, bytes);
        // As other programs do, numbers beyond the palette stand for its first colour.
        const std::size_t number = little_endian(bytes, 0, bytes.size());
        return palette_[number < palette_.size() ? number : 0];
    }

    const TgaHeader& header_;
    std::vector<Codes> palette_;
    ByteSource source_;
    std::size_t left_in_packet_ = 0;
    bool repeats_ = false;
    Codes pixel_ = {};
};

} // namespace

CodedHeader read_tga_header(std::istream& file) {
    const TgaHeader tga(file);
    const CodedHeader header = {tga.width, tga.height, channels_of(tga.layout), 8};
    // A packet has up to 128 pixels.
    const double pixel_bytes = static_cast<double>(tga.pixel_bytes);
    check_claims(byte_count(file), header, tga.has_runs ? 128 / (1 + pixel_bytes) : 1 / pixel_bytes);
    return header;
}

void decode_tga(std::istream& file, CodeRows& rows) {
    const TgaHeader header(file);
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    const auto channels = static_cast<std::size_t>(channels_of(header.layout));
    TgaPixels pixels(file, header);
    std::vector<std::uint8_t> row(width * channels);
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            const Codes codes = pixels.next();
            const std::size_t column = header.is_right_first ? width - 1 - x : x;
            std::copy_n(codes.begin(), channels,
                        row.begin() + static_cast<std::ptrdiff_t>(column * channels));
        }
        rows.put(row.data(), width, {.y = header.is_top_first ? y : height - 1 - y});
    }
}

} // namespace nusselt::image
