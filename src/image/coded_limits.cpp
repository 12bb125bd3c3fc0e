/// Checks that stb leaves out: whether a file can hold the pixels that its header claims. stb allocates memory
/// for them first, and pixels of JPG, TGA and BMP files that are missing become black without an error.

#include "image/codecs.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace nusselt::image {

namespace {

[[noreturn]] void fail_as_cut_off() {
    throw std::runtime_error("the file is too small for its pixels; was it cut off?");
}

std::int64_t byte_at(std::string_view file, std::size_t i) {
    return i < file.size() ? static_cast<unsigned char>(file[i]) : 0;
}

/// \returns the integer of `size` bytes, the lowest one first
std::int64_t little_endian(std::string_view file, std::size_t begin, std::size_t size) {
    std::int64_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = 256 * value + byte_at(file, begin + i);
    return value;
}

/// \returns an integer of four bytes, the highest one first
std::int64_t big_endian(std::string_view file, std::size_t begin) {
    std::int64_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = 256 * value + byte_at(file, begin + i);
    return value;
}

/// Bytes of the rows of an image or of a pass of interlacing: each begins with the number of its filter.
std::int64_t png_bytes(std::int64_t width, std::int64_t height, std::int64_t bits_per_pixel) {
    return width == 0 ? 0 : height * (1 + (width * bits_per_pixel + 7) / 8);
}

struct PngChunk {
    std::string_view type;
    std::string_view data;
};

/// The chunks of a PNG file up to its end mark. stb allocates memory for what they claim, so each must fit into the file.
std::vector<PngChunk> png_chunks(std::string_view file) {
    constexpr std::size_t kSignature = 8, kLength = 4, kType = 4, kChecksum = 4;
    std::vector<PngChunk> chunks;
    std::string_view rest = file.substr(std::min(kSignature, file.size()));
    for (;;) {
        const auto length = static_cast<std::size_t>(big_endian(rest, 0));
        if (rest.size() < kLength + kType || rest.size() - kLength - kType < length) fail_as_cut_off();
        chunks.push_back({rest.substr(kLength, kType), rest.substr(kLength + kType, length)});
        if (chunks.back().type == "IEND") return chunks;
        rest.remove_prefix(std::min(kLength + kType + length + kChecksum, rest.size()));
    }
}

/// \returns the number of bytes that the compressed pixels of a PNG file give, at most `enough` and what is inflated with
/// them at once
std::int64_t inflated_bytes(const std::vector<PngChunk>& chunks, std::int64_t enough) {
    // Files for phones of Apple have a chunk of this name in front and no header of zlib.
    const bool has_zlib_header = chunks.front().type != "CgBI";
    z_stream stream = {};
    if (inflateInit2(&stream, has_zlib_header ? MAX_WBITS : -MAX_WBITS) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, inflateEnd);
    std::array<unsigned char, 1 << 16> discarded;
    std::int64_t count = 0;
    int status = Z_OK;
    for (const PngChunk& chunk : chunks) {
        if (chunk.type != "IDAT") continue;
        stream.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(chunk.data.data()));
        stream.avail_in = static_cast<unsigned>(chunk.data.size());
        do {
            stream.next_out = discarded.data();
            stream.avail_out = static_cast<unsigned>(discarded.size());
            status = inflate(&stream, Z_NO_FLUSH);
            count += static_cast<std::int64_t>(discarded.size() - stream.avail_out);
        } while (status == Z_OK && stream.avail_out == 0 && count < enough);
        const bool is_used_up = status == Z_OK || status == Z_BUF_ERROR;
        if (!is_used_up || count >= enough) break;
    }
    return count;
}

/// A byte of deflate may become 1032: what the pixels take is known only when they were inflated once.
void check_png(std::string_view file, std::int64_t width, std::int64_t height) {
    // Behind signature, length and type of IHDR, which CgBI (4 bytes and the 12 of any chunk) may precede.
    const std::size_t header = file.substr(12, 4) == "CgBI" ? 32 : 16;
    const std::int64_t color_type = byte_at(file, header + 9);
    const std::int64_t channels = color_type == 2 ? 3 : color_type == 4 ? 2 : color_type == 6 ? 4 : 1;
    const std::int64_t bits = channels * byte_at(file, header + 8);
    std::int64_t needed = 0;
    if (byte_at(file, header + 12) == 0) {
        needed = png_bytes(width, height, bits);
    } else {
        struct Pass {
            std::int64_t x, y, step_x, step_y;
        };
        for (const Pass& pass : {Pass{0, 0, 8, 8}, Pass{4, 0, 8, 8}, Pass{0, 4, 4, 8}, Pass{2, 0, 4, 4},
                                 Pass{0, 2, 2, 4}, Pass{1, 0, 2, 2}, Pass{0, 1, 1, 2}})
            needed += png_bytes((width - pass.x + pass.step_x - 1) / pass.step_x,
                                (height - pass.y + pass.step_y - 1) / pass.step_y, bits);
    }
    if (inflated_bytes(png_chunks(file), needed) < needed) fail_as_cut_off();
}

/// Rows of uncompressed pixels, the only ones that are decoded, are multiples of four bytes.
void check_bmp(std::string_view file, std::int64_t width, std::int64_t height) {
    const bool is_old = little_endian(file, 14, 4) == 12; // sizes have two bytes in this header
    const std::int64_t bits = little_endian(file, is_old ? 24 : 28, 2);
    const std::int64_t row = (width * bits + 31) / 32 * 4;
    if (little_endian(file, 10, 4) + height * row > std::int64_t(file.size())) fail_as_cut_off();
}

/// Checks the Huffman tables of a segment and notes which are defined: stb writes behind a table of more than 256 values.
void check_huffman_tables(std::string_view segment, std::array<bool, 32>& is_defined) {
    constexpr std::size_t kLengths = 16;
    for (std::size_t i = 0; i < segment.size();) {
        const auto table = static_cast<std::size_t>(byte_at(segment, i));
        std::int64_t values = 0;
        for (std::size_t k = 1; k <= kLengths; ++k) values += byte_at(segment, i + k);
        if (values > 256)
            throw std::runtime_error("a Huffman table of this JPG file has more than 256 values");
        if (table < is_defined.size()) is_defined[table] = true;
        i += 1 + kLengths + static_cast<std::size_t>(values);
    }
}

/// Checks that a scan uses tables that are defined: stb would read memory that was never written.
/// \param is_progressive only these files have scans of a part of the coefficients; others may claim to
void check_scan(std::string_view segment, bool is_progressive, const std::array<bool, 32>& is_defined) {
    const auto components = static_cast<std::size_t>(byte_at(segment, 0));
    const bool has_dc = !is_progressive || byte_at(segment, 1 + 2 * components) == 0;
    const bool has_ac = !is_progressive || byte_at(segment, 2 + 2 * components) > 0;
    for (std::size_t i = 0; i < components; ++i) {
        const std::int64_t tables = byte_at(segment, 2 + 2 * i);
        const auto dc = static_cast<std::size_t>(tables / 16);
        const auto ac = static_cast<std::size_t>(16 + tables % 16);
        if ((has_dc && !is_defined[dc]) || (has_ac && !is_defined[ac]))
            throw std::runtime_error("a scan of this JPG file uses a Huffman table that it does not define");
    }
}

/// A block of 8 x 8 pixels takes one bit at least, so a byte makes up to 512 pixels, twice that with subsampled
/// channels. The end mark cannot occur in the data of pixels, though in a preview before them.
void check_jpg(std::string_view file, std::int64_t pixel_count) {
    constexpr std::string_view kEnd = "\xFF\xD9";
    if (pixel_count / 1024 > std::int64_t(file.size())) fail_as_cut_off();
    if (file.find(kEnd) == std::string_view::npos) fail_as_cut_off();
    constexpr std::int64_t kBaseline = 0xC0, kExtended = 0xC1, kHuffmanTables = 0xC4, kScan = 0xDA;
    std::array<bool, 32> is_defined = {};
    bool is_progressive = true;
    // Whatever looks like a segment is taken for one, also in the data of pixels and in previews: there, bytes of 0xFF are
    // followed by zeros or marks without a segment.
    for (std::size_t at = file.find('\xFF'); at != std::string_view::npos; at = file.find('\xFF', at)) {
        const std::int64_t mark = byte_at(file, ++at);
        if (mark == 0 || mark == 0xFF || (mark >= 0xD0 && mark <= 0xD9) || mark == 1) continue;
        const std::int64_t length = 256 * byte_at(file, at + 1) + byte_at(file, at + 2);
        const std::size_t begin = std::min(at + 3, file.size());
        const std::string_view segment =
            file.substr(begin, static_cast<std::size_t>(std::max<std::int64_t>(length - 2, 0)));
        if (mark == kHuffmanTables) check_huffman_tables(segment, is_defined);
        if (mark == kBaseline || mark == kExtended) is_progressive = false;
        if (mark == kScan) check_scan(segment, is_progressive, is_defined);
        at = begin + segment.size();
    }
}

/// Counts the pixels of a TGA file, run by run.
void check_tga(std::string_view file, std::int64_t pixel_count) {
    constexpr std::size_t kHeaderSize = 18;
    const std::int64_t palette_bytes =
        byte_at(file, 1) == 0 ? 0 : little_endian(file, 5, 2) * ((byte_at(file, 7) + 7) / 8);
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

void check_coded_file(std::string_view file, std::int64_t width, std::int64_t height) {
    // stb knows further formats, which no one needs here. No TGA file begins like this.
    for (const std::string_view other : {"GIF8", "8BPS", "\x53\x80\xF6\x34", "P5", "P6", "#?"}) {
        if (file.starts_with(other))
            throw std::runtime_error("this is neither PNG, JPG, TGA nor BMP; check its name or convert it");
    }
    check_size(width, height);
    if (file.starts_with("\x89PNG")) {
        check_png(file, width, height);
    } else if (file.starts_with("\xFF\xD8")) {
        check_jpg(file, width * height);
    } else if (file.starts_with("BM")) {
        check_bmp(file, width, height);
    } else {
        check_tga(file, width * height);
    }
}

} // namespace nusselt::image
