#include "image/formats/bmp.h"

#include "image/formats/bytes.h"
#include "image/image.h"

#include <algorithm>
#include <array>
#include <bit>
#include <istream>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::image {

namespace {

constexpr std::size_t kFileHeaderSize = 14;
constexpr std::size_t kMaskBegin = 54; ///< behind the oldest header that may have masks, or inside newer ones
constexpr std::size_t kKnownHeaderBytes = 70; ///< up to the end of the masks
constexpr std::uint32_t kOldHeaderSize = 12, kHeaderSize = 40, kHeaderSizeWithAlphaMask = 56;
constexpr std::uint32_t kUncompressed = 0, kMasks = 3;

/// The bits of a pixel that hold a channel.
struct Mask {
    std::uint32_t bits = 0;

    /// The channel scaled to 8 bits: fewer repeat from the top, so that all ones become 255.
    std::uint8_t code_in(std::uint32_t pixel) const {
        const int shift = std::countr_zero(bits);
        const int count = std::bit_width(bits) - shift;
        std::uint32_t code = (pixel & bits) >> shift;
        if (count >= 8) return static_cast<std::uint8_t>(code >> (count - 8));
        code <<= 8 - count;
        for (int filled = count; filled < 8; filled *= 2) code |= code >> filled;
        return static_cast<std::uint8_t>(code);
    }
};

struct BmpHeader {
    /// \throws std::runtime_error for variants that are not supported and files that are too small
    explicit BmpHeader(std::istream& file);

    bool has_palette() const { return bits <= 8; }

    int width;
    int height;
    bool is_top_first;
    std::uint32_t bits; ///< of a pixel
    std::array<Mask, 3> colours;
    Mask alpha; ///< no bits if there is none
    std::int64_t palette_begin;
    std::size_t palette_entry_bytes;
    std::int64_t pixels_begin;
    std::size_t row_bytes;

private:
    void read_masks(std::istream& file, std::string_view header, std::uint32_t header_size,
                    std::uint32_t compression);
    bool is_transparent_everywhere(std::istream& file) const;
};

BmpHeader::BmpHeader(std::istream& file) {
    const std::string header = bytes_at(file, 0, kKnownHeaderBytes);
    const auto field = [&](std::size_t begin, std::size_t size) {
        return little_endian(header, begin, size);
    };
    const std::uint32_t header_size = field(14, 4);
    const bool is_old = header_size == kOldHeaderSize;
    if (!is_old && header_size < kHeaderSize)
        throw std::runtime_error(
            "this BMP file has a header of " + std::to_string(header_size) +
            " bytes; headers of 12 bytes and of 40 or more are supported; convert the file "
            "to PNG");
    const auto signed_height =
        is_old ? static_cast<std::int32_t>(field(20, 2)) : static_cast<std::int32_t>(field(22, 4));
    width = static_cast<std::int32_t>(is_old ? field(18, 2) : field(18, 4));
    is_top_first = signed_height < 0;
    height = is_top_first ? static_cast<std::int32_t>(0 - field(22, 4)) : signed_height;
    bits = is_old ? field(24, 2) : field(28, 2);
    const std::uint32_t compression = is_old ? kUncompressed : field(30, 4);

    const bool has_masks = compression == kMasks && (bits == 16 || bits == 32);
    if (compression != kUncompressed && !has_masks)
        throw std::runtime_error(
            "this BMP file has " + std::to_string(bits) + " bits per pixel and the compression " +
            std::to_string(compression) +
            "; the compressions 0 (none) and, for 16 and 32 bits, 3 (masks) are supported; "
            "convert the file to PNG");
    if (bits != 1 && bits != 4 && bits != 8 && bits != 16 && bits != 24 && bits != 32)
        throw std::runtime_error(
            "this BMP file has " + std::to_string(bits) +
            " bits per pixel; 1, 4, 8, 16, 24 and 32 are supported; convert the file to PNG");
    palette_begin = static_cast<std::int64_t>(kFileHeaderSize) + header_size;
    palette_entry_bytes = is_old ? 3 : 4;
    pixels_begin = field(10, 4);
    check_size(width, height);
    row_bytes = (static_cast<std::size_t>(width) * bits + 31) / 32 * 4;
    if (pixels_begin + std::int64_t{height} * static_cast<std::int64_t>(row_bytes) > byte_count(file))
        fail_as_cut_off();
    read_masks(file, header, header_size, compression);
}

void BmpHeader::read_masks(std::istream& file, std::string_view header, std::uint32_t header_size,
                           std::uint32_t compression) {
    if (has_palette()) return;
    if (compression == kMasks) {
        for (std::size_t c = 0; c < 3; ++c) colours[c].bits = little_endian(header, kMaskBegin + 4 * c, 4);
        if (header_size >= kHeaderSizeWithAlphaMask) alpha.bits = little_endian(header, kMaskBegin + 12, 4);
        if (std::any_of(colours.begin(), colours.end(), [](Mask mask) { return mask.bits == 0; }))
            throw std::runtime_error(
                "this BMP file has bit masks, but that of red, green or blue is 0; the file is damaged");
    } else if (bits == 16) {
        colours = {{{0x7c00}, {0x03e0}, {0x001f}}};
    } else {
        colours = {{{0xff0000}, {0x00ff00}, {0x0000ff}}};
        // Many programs leave the fourth byte zero, which is not meant for alpha then.
        alpha.bits = bits == 32 ? 0xff000000 : 0;
        if (is_transparent_everywhere(file)) alpha.bits = 0;
    }
}

bool BmpHeader::is_transparent_everywhere(std::istream& file) const {
    if (alpha.bits == 0) return false;
    ByteSource source(file, pixels_begin);
    for (int y = 0; y < height; ++y) {
        const std::string_view row = source.take(row_bytes);
        for (std::size_t i = 3; i < row.size(); i += 4)
            if (row[i] != 0) return false;
    }
    return true;
}

using Palette = std::array<std::array<std::uint8_t, 3>, 256>;

/// Entries that the file does not have are black.
Palette read_palette(std::istream& file, const BmpHeader& header) {
    Palette palette = {};
    const std::int64_t space = std::max<std::int64_t>(0, header.pixels_begin - header.palette_begin);
    const std::size_t count =
        std::min(palette.size(), static_cast<std::size_t>(space) / header.palette_entry_bytes);
    const std::string entries = bytes_at(file, header.palette_begin, count * header.palette_entry_bytes);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            palette[i][c] =
                static_cast<std::uint8_t>(little_endian(entries, i * header.palette_entry_bytes + 2 - c, 1));
    return palette;
}

/// \param bits 1, 4 or 8; the first pixel has the highest bits of its byte
std::size_t palette_number(std::string_view row, std::size_t x, std::uint32_t bits) {
    const std::size_t per_byte = 8 / bits;
    const auto byte = static_cast<std::uint8_t>(row[x / per_byte]);
    return byte >> (8 - bits * (x % per_byte + 1)) & ((1u << bits) - 1);
}

} // namespace

CodedHeader read_bmp_header(std::istream& file) {
    const BmpHeader header(file);
    return {header.width, header.height, header.alpha.bits == 0 ? 3 : 4, 8};
}

void decode_bmp(std::istream& file, CodeRows& rows) {
    const BmpHeader header(file);
    const Palette palette = header.has_palette() ? read_palette(file, header) : Palette();
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    std::vector<std::uint8_t> codes;
    ByteSource source(file, header.pixels_begin);
    for (std::size_t y = 0; y < height; ++y) {
        const std::string_view row = source.take(header.row_bytes);
        codes.clear();
        for (std::size_t x = 0; x < width; ++x) {
            if (header.has_palette()) {
                const auto& colour = palette[palette_number(row, x, header.bits)];
                codes.insert(codes.end(), colour.begin(), colour.end());
                continue;
            }
            const std::uint32_t pixel = little_endian(row, x * header.bits / 8, header.bits / 8);
            for (const Mask& mask : header.colours) codes.push_back(mask.code_in(pixel));
            if (header.alpha.bits != 0) codes.push_back(header.alpha.code_in(pixel));
        }
        rows.put(codes.data(), width, {.y = header.is_top_first ? y : height - 1 - y});
    }
}

} // namespace nusselt::image
