#include "image/formats/png.h"

#include "image/codecs.h"
#include "image/formats/bytes.h"
#include "image/srgb.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <exception>
#include <istream>
#include <limits>
#include <new>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace nusselt::image {

namespace {

/// The message of libpng's last error. It stands in an array, as the jump that follows runs no destructors.
using Message = std::array<char, 128>;

[[noreturn]] void jump_with_message(png_structp png, png_const_charp text) {
    auto& message = *static_cast<Message*>(png_get_error_ptr(png));
    std::snprintf(message.data(), message.size(), "%s", text);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

/// Runs `step`, which calls libpng and has no objects with destructors.
/// \returns false if libpng reported an error
template <class Step>
bool succeeds(png_structp png, const Step& step) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    step();
    return true;
}

/// The objects that libpng allocates for reading.
struct PngMemory {
    explicit PngMemory(Message& message)
        : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, jump_with_message, ignore_warning)) {
        if (png == nullptr) throw std::bad_alloc();
    }
    ~PngMemory() { png_destroy_read_struct(&png, &info, nullptr); }
    PngMemory(const PngMemory&) = delete;
    PngMemory& operator=(const PngMemory&) = delete;

    png_structp png;
    png_infop info = nullptr;
};

/// The colours of a file that stores their indices.
struct PngPalette {
    /// \param place  of the indices, for messages
    /// \returns the channels of one pixel after those of the other, until the next call
    const std::vector<png_byte>& codes_of(const std::vector<png_byte>& indices, std::size_t count,
                                          RowPlace place);

    std::vector<std::array<png_byte, 4>> colours; ///< with alpha
    std::size_t channels = 3;                     ///< 4 if the file has alpha
    std::vector<png_byte> codes;
};

const std::vector<png_byte>& PngPalette::codes_of(const std::vector<png_byte>& indices, std::size_t count,
                                                  RowPlace place) {
    codes.resize(channels * count);
    for (std::size_t i = 0; i < count; ++i) {
        if (indices[i] >= colours.size())
            throw std::runtime_error("the pixel (" + std::to_string(place.x + i * place.step) + ", " +
                                     std::to_string(place.y) + ") has the palette index " +
                                     std::to_string(indices[i]) + ", but the palette has only " +
                                     std::to_string(colours.size()) + " colours; the file is damaged");
        std::copy_n(colours[indices[i]].begin(), channels,
                    codes.begin() + static_cast<std::ptrdiff_t>(i * channels));
    }
    return codes;
}

/// Where libpng reads from.
struct PngSource {
    std::istream& file;
    std::size_t bytes_left = std::numeric_limits<std::size_t>::max(); ///< that may be read now
};

class PngReader {
public:
    /// Reads everything before the pixels.
    explicit PngReader(std::istream& file);

    CodedHeader header() const { return header_; }
    void read_rows(CodeRows& rows);

private:
    template <class Step>
    void call(const Step& step) const;
    void read_palette();
    template <class Code>
    void read_rows_of(CodeRows& rows);
    template <class Code>
    void put(const std::vector<Code>& row, std::size_t count, RowPlace place, CodeRows& rows);
    static void read_bytes(png_structp png, png_bytep target, std::size_t count);

    PngSource source_;
    Message message_ = {};
    PngMemory memory_;
    png_structp png_;
    CodedHeader header_;
    PngPalette palette_; ///< empty if the file stores colours
};

template <class Step>
void PngReader::call(const Step& step) const {
    if (succeeds(png_, step)) return;
    const std::string problem = message_.data();
    // "Out of memory" of its allocations, "insufficient memory" of zlib.
    if (problem.find(" memory") != std::string::npos) throw std::bad_alloc();
    throw std::runtime_error("cannot decode its PNG data (" + problem +
                             "); the file may be damaged or truncated");
}

void PngReader::read_bytes(png_structp png, png_bytep target, std::size_t count) {
    PngSource& source = *static_cast<PngSource*>(png_get_io_ptr(png));
    if (count > source.bytes_left) png_error(png, "Too much image data");
    source.bytes_left -= count;
    if (!source.file.read(reinterpret_cast<char*>(target), static_cast<std::streamsize>(count)))
        png_error(png, "the file ends too early");
}

PngReader::PngReader(std::istream& file) : source_{file}, memory_(message_), png_(memory_.png) {
    const std::int64_t file_size = byte_count(file);
    call([&] {
        memory_.info = png_create_info_struct(png_);
        png_set_read_fn(png_, &source_, read_bytes);
        // Sizes are checked below. Texts, colour profiles and the like are skipped without inflating them.
        png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
        // Pixels that go on after the last row are an error, not a warning.
        png_set_benign_errors(png_, 0);
        png_read_info(png_, memory_.info);
    });
    header_.width = static_cast<int>(png_get_image_width(png_, memory_.info));
    header_.height = static_cast<int>(png_get_image_height(png_, memory_.info));
    // A byte of deflate becomes 1032 at most.
    const int bits_per_pixel = png_get_channels(png_, memory_.info) * png_get_bit_depth(png_, memory_.info);
    check_claims(file_size, header_, 8.0 * 1032 / bits_per_pixel);
    const bool has_palette = png_get_color_type(png_, memory_.info) == PNG_COLOR_TYPE_PALETTE;
    call([&] {
        // A single colour that stands for transparent pixels is ignored.
        if (has_palette)
            png_set_packing(png_);
        else
            png_set_expand_gray_1_2_4_to_8(png_);
        if (std::endian::native == std::endian::little) png_set_swap(png_);
        png_read_update_info(png_, memory_.info);
    });
    if (has_palette) read_palette();
    header_.channels =
        has_palette ? static_cast<int>(palette_.channels) : png_get_channels(png_, memory_.info);
    header_.bits = png_get_bit_depth(png_, memory_.info);
}

/// libpng would take indices beyond the palette for black.
void PngReader::read_palette() {
    png_colorp colours = nullptr;
    int colour_count = 0;
    png_get_PLTE(png_, memory_.info, &colours, &colour_count);
    png_bytep alphas = nullptr;
    int alpha_count = 0;
    png_get_tRNS(png_, memory_.info, &alphas, &alpha_count, nullptr);
    palette_.channels = alpha_count > 0 ? 4 : 3;
    for (int i = 0; i < colour_count; ++i)
        palette_.colours.push_back(
            {colours[i].red, colours[i].green, colours[i].blue, i < alpha_count ? alphas[i] : png_byte(255)});
}

template <class Code>
void PngReader::put(const std::vector<Code>& row, std::size_t count, RowPlace place, CodeRows& rows) {
    if constexpr (sizeof(Code) == 1) {
        if (!palette_.colours.empty()) {
            rows.put(palette_.codes_of(row, count, place).data(), count, place);
            return;
        }
    }
    rows.put(row.data(), count, place);
}

template <class Code>
void PngReader::read_rows_of(CodeRows& rows) {
    std::vector<Code> row(static_cast<std::size_t>(header_.width) *
                          static_cast<std::size_t>(header_.channels));
    const bool is_interlaced = png_get_interlace_type(png_, memory_.info) != PNG_INTERLACE_NONE;
    const auto read_row = [&](std::size_t count, RowPlace place) {
        // With the last row, libpng inflates all that follows it, which may be gigabytes. No row needs more than this.
        constexpr std::size_t kSlack = std::size_t(1) << 16;
        source_.bytes_left = 2 * row.size() * sizeof(Code) + kSlack;
        call([&] { png_read_row(png_, reinterpret_cast<png_bytep>(row.data()), nullptr); });
        put(row, count, place, rows);
    };
    const auto width = static_cast<std::size_t>(header_.width);
    const auto height = static_cast<std::size_t>(header_.height);
    if (!is_interlaced) {
        for (std::size_t y = 0; y < height; ++y) read_row(width, {.y = y});
        return;
    }
    for (std::size_t pass = 0; pass < PNG_INTERLACE_ADAM7_PASSES; ++pass) {
        const std::size_t columns = PNG_PASS_COLS(width, pass);
        const std::size_t pass_height = columns == 0 ? 0 : PNG_PASS_ROWS(height, pass);
        for (std::size_t y = 0; y < pass_height; ++y)
            read_row(columns, {.y = PNG_ROW_FROM_PASS_ROW(y, pass),
                               .x = PNG_PASS_START_COL(pass),
                               .step = std::size_t(PNG_PASS_COL_OFFSET(pass))});
    }
}

void PngReader::read_rows(CodeRows& rows) {
    if (header_.bits == 16)
        read_rows_of<std::uint16_t>(rows);
    else
        read_rows_of<std::uint8_t>(rows);
    source_.bytes_left = std::numeric_limits<std::size_t>::max();
    call([this] { png_read_end(png_, nullptr); });
}

/// A file that is written to a stream.
struct PngWriter {
    explicit PngWriter(std::ostream& target)
        : stream(target),
          png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, jump_with_message, ignore_warning)) {
        if (png == nullptr) throw std::bad_alloc();
    }
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    template <class Step>
    void call(const Step& step) {
        if (succeeds(png, step)) return;
        if (error_of_stream) std::rethrow_exception(error_of_stream);
        throw std::runtime_error("libpng reports: " + std::string(message.data()));
    }

    /// Exceptions must not pass through libpng.
    static void write_bytes(png_structp png, png_bytep bytes, std::size_t count) {
        auto& writer = *static_cast<PngWriter*>(png_get_io_ptr(png));
        try {
            writer.stream.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(count));
        } catch (...) {
            writer.error_of_stream = std::current_exception();
        }
        if (writer.error_of_stream) png_error(png, "the stream failed");
    }

    std::ostream& stream;
    std::exception_ptr error_of_stream;
    Message message = {};
    png_structp png;
    png_infop info = nullptr;
};

/// \param fill_row  called with the number of each row from the top, and with its 3 * width bytes to fill
template <class FillRow>
void write_png(std::ostream& stream, int width, int height, const FillRow& fill_row) {
    PngWriter writer(stream);
    writer.call([&] {
        writer.info = png_create_info_struct(writer.png);
        png_set_write_fn(writer.png, &writer, PngWriter::write_bytes, nullptr);
        png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(width),
                     static_cast<png_uint_32>(height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_write_info(writer.png, writer.info);
    });
    std::vector<png_byte> row(3 * static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        fill_row(static_cast<std::size_t>(y), row);
        writer.call([&] { png_write_row(writer.png, row.data()); });
    }
    writer.call([&] { png_write_end(writer.png, nullptr); });
}

} // namespace

CodedHeader read_png_header(std::istream& file) { return PngReader(file).header(); }

void decode_png(std::istream& file, CodeRows& rows) { PngReader(file).read_rows(rows); }

void encode_png(std::ostream& stream, const Image& image, double scale) {
    write_png(stream, image.width, image.height, [&](std::size_t y, std::vector<png_byte>& row) {
        const float* const pixels = &image.pixels[y * row.size()];
        std::transform(pixels, pixels + row.size(), row.begin(), [scale](float value) {
            return static_cast<png_byte>(std::lround(255 * display_code(scale * double(value))));
        });
    });
}

void encode_png_codes(std::ostream& stream, int width, int height, const std::vector<unsigned char>& codes) {
    write_png(stream, width, height, [&](std::size_t y, std::vector<png_byte>& row) {
        std::copy_n(&codes[y * row.size()], row.size(), row.begin());
    });
}

} // namespace nusselt::image
