/// PNG, TGA and BMP files decode to the codes that a second, independent reader finds in them (stb), JPG files nearly.

#include "common/source_folder.h"
#include "image/coded_file.h"
#include "image_fixture.h"

#include <csetjmp>
#include <cstdio> // jpeglib.h needs it

#include <jpeglib.h>
#include <png.h>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <memory>
#include <sstream>

namespace nusselt::image::test {

namespace {

using SecondReader = ImageTest;

/// Codes as fractions, like those of decode_codes() without a transfer function.
std::vector<float> fractions_by_stb(const std::string& file, int channels) {
    const auto* bytes = reinterpret_cast<const stbi_uc*>(file.data());
    const int size = static_cast<int>(file.size());
    int width = 0, height = 0, channels_in_file = 0;
    const auto fractions = [&](auto* codes, float largest) {
        EXPECT_NE(codes, nullptr) << stbi_failure_reason();
        if (codes == nullptr) return std::vector<float>();
        const std::unique_ptr<std::remove_pointer_t<decltype(codes)>, void (*)(void*)> owner(codes,
                                                                                             stbi_image_free);
        std::vector<float> values(codes,
                                  codes + std::size_t(width) * std::size_t(height) * std::size_t(channels));
        for (float& value : values) value /= largest;
        return values;
    };
    if (stbi_is_16_bit_from_memory(bytes, size) != 0)
        return fractions(stbi_load_16_from_memory(bytes, size, &width, &height, &channels_in_file, channels),
                         65535);
    return fractions(stbi_load_from_memory(bytes, size, &width, &height, &channels_in_file, channels), 255);
}

Texels fractions(const std::string& file, int channels) {
    std::istringstream stream(file);
    return decode_codes(stream, channels, [](double code) { return code; });
}

CodedHeader header_of(const std::string& file) {
    std::istringstream stream(file);
    return read_coded_header(stream);
}

void expect_same(const std::string& file, const std::string& name) {
    const CodedHeader header = header_of(file);
    const Texels own = fractions(file, header.channels == 2 ? 4 : header.channels);
    EXPECT_EQ(own.values, fractions_by_stb(file, own.channels)) << name;
    EXPECT_EQ(fractions(file, 3).values, fractions_by_stb(file, 3)) << name;
}

/// Noise for files.
std::string random_bytes(std::size_t count) {
    std::mt19937 engine(7);
    std::string bytes(count, '\0');
    for (char& byte : bytes) byte = static_cast<char>(engine());
    return bytes;
}

std::string little_endian_bytes(std::uint64_t value, std::size_t size) {
    std::string bytes;
    for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i));
    return bytes;
}

std::string png(int width, int height, int bits, int colour_type, int interlacing) {
    std::string file;
    png_structp write = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(write);
    png_set_write_fn(
        write, &file,
        [](png_structp to, png_bytep bytes, std::size_t count) {
            static_cast<std::string*>(png_get_io_ptr(to))
                ->append(reinterpret_cast<const char*>(bytes), count);
        },
        nullptr);
    png_set_IHDR(write, info, png_uint_32(width), png_uint_32(height), bits, colour_type, interlacing,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    const std::string noise = random_bytes(std::size_t(width) * std::size_t(height) * 8 + 1024);
    if (colour_type == PNG_COLOR_TYPE_PALETTE) {
        const auto* entries = reinterpret_cast<const png_color*>(noise.data());
        png_set_PLTE(write, info, entries, 1 << bits);
        // Alpha of half of the entries; the others are opaque.
        png_set_tRNS(write, info, reinterpret_cast<const png_byte*>(noise.data()), 1 << (bits - 1), nullptr);
    }
    png_write_info(write, info);
    std::vector<png_bytep> rows;
    for (std::size_t y = 0; y < std::size_t(height); ++y)
        rows.push_back(reinterpret_cast<png_bytep>(const_cast<char*>(noise.data())) +
                       8 * y * std::size_t(width));
    png_write_image(write, rows.data());
    png_write_end(write, nullptr);
    png_destroy_write_struct(&write, &info);
    return file;
}

TEST_F(SecondReader, PngOfEveryKind) {
    struct Kind {
        int colour_type;
        std::vector<int> bits;
    };
    for (const Kind& kind :
         {Kind{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}}, Kind{PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}},
          Kind{PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}}, Kind{PNG_COLOR_TYPE_RGB, {8, 16}},
          Kind{PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}})
        for (const int bits : kind.bits)
            for (const int interlacing : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7})
                for (const auto& [width, height] : {std::pair{13, 11}, {1, 1}, {3, 9}, {5, 1}})
                    expect_same(png(width, height, bits, kind.colour_type, interlacing),
                                "colour type " + std::to_string(kind.colour_type) + ", " +
                                    std::to_string(bits) + " bits, interlacing " +
                                    std::to_string(interlacing) + ", " + std::to_string(width) + " x " +
                                    std::to_string(height));
}

/// \param orientation 0, or 32 if the first row is on top
std::string tga(int type, int palette_length, int palette_bits, int bits, int orientation) {
    const std::size_t palette_bytes = std::size_t(palette_length) * std::size_t((palette_bits + 7) / 8);
    const std::string header = {3,          char(palette_length > 0),
                                char(type), 0,
                                0,          char(palette_length),
                                0,          char(palette_bits),
                                0,          0,
                                0,          0,
                                13,         0,
                                7,          0,
                                char(bits), char(orientation)};
    return header + "id." + random_bytes(palette_bytes + 13 * 7 * 4 * 2);
}

TEST_F(SecondReader, TgaOfEveryKind) {
    for (const int runs : {0, 8})
        for (const int orientation : {0, 32}) {
            for (const int bits : {15, 16, 24, 32})
                expect_same(tga(2 + runs, 0, 0, bits, orientation), "colour, " + std::to_string(bits));
            for (const int bits : {8, 16})
                expect_same(tga(3 + runs, 0, 0, bits, orientation), "grey, " + std::to_string(bits));
            for (const int palette_bits : {8, 15, 16, 24, 32})
                for (const int bits : {8, 16})
                    expect_same(tga(1 + runs, 100, palette_bits, bits, orientation),
                                "palette, " + std::to_string(palette_bits) + ", " + std::to_string(bits));
        }
}

// Alpha that is 1 everywhere is left out; where some pixel is transparent, all alphas are there, also those before it.
TEST_F(SecondReader, AlphaIsKeptUnlessItIsOpaque) {
    const auto grey_alpha_png = [&](png_byte last_alpha) {
        std::string rows(5 * 4 * 2, '\xFF');
        for (std::size_t i = 0; i < rows.size(); i += 2) rows[i] = char(7 * i);
        rows.back() = char(last_alpha);
        png_image image = {};
        image.version = PNG_IMAGE_VERSION;
        image.width = 5;
        image.height = 4;
        image.format = PNG_FORMAT_GA;
        png_image_write_to_file(&image, in_folder("a.png").c_str(), 0, rows.data(), 0, nullptr);
        return read_bytes(in_folder("a.png"));
    };
    EXPECT_EQ(header_of(grey_alpha_png(255)).channels, 2);
    EXPECT_EQ(fractions(grey_alpha_png(255), 4).channels, 3);
    EXPECT_EQ(fractions(grey_alpha_png(255), 2).channels, 1);
    expect_same(grey_alpha_png(255), "opaque");
    EXPECT_EQ(fractions(grey_alpha_png(254), 4).channels, 4);
    EXPECT_EQ(fractions(grey_alpha_png(254), 2).channels, 2);
    expect_same(grey_alpha_png(254), "the last pixel is transparent");
}

// stb ignores the bit, which no other program here knows either.
TEST_F(SecondReader, TgaStoredFromRightToLeft) {
    for (const int runs : {0, 8})
        for (const int orientation : {0, 32}) {
            const std::vector<float> left_first = fractions(tga(2 + runs, 0, 0, 24, orientation), 3).values;
            const std::vector<float> right_first =
                fractions(tga(2 + runs, 0, 0, 24, orientation + 16), 3).values;
            for (std::size_t y = 0; y < 7; ++y)
                for (std::size_t x = 0; x < 13; ++x)
                    for (std::size_t c = 0; c < 3; ++c)
                        ASSERT_EQ(right_first[3 * (13 * y + x) + c], left_first[3 * (13 * y + 12 - x) + c]);
        }
}

/// 13 x 7 pixels. \param masks in the file, of red, green, blue and, in larger headers, alpha
std::string bmp(std::uint32_t header_size, std::uint32_t bits, const std::vector<std::uint32_t>& masks,
                const std::string& pixels) {
    const auto n = little_endian_bytes;
    const bool is_old = header_size == 12;
    std::string header =
        n(header_size, 4) + n(13, is_old ? 2 : 4) + n(7, is_old ? 2 : 4) + n(1, 2) + n(bits, 2);
    if (!is_old) header += n(masks.empty() ? 0 : 3, 4) + std::string(20, '\0');
    for (const std::uint32_t mask : masks) header += n(mask, 4);
    header.resize(std::max(header.size(), std::size_t(header_size)));
    if (bits <= 8) header += random_bytes((std::size_t(is_old ? 3 : 4)) << bits);
    return "BM" + n(0, 8) + n(std::uint32_t(14 + header.size()), 4) + header + pixels;
}

std::string without_fourth_bytes(std::string bytes) {
    for (std::size_t i = 3; i < bytes.size(); i += 4) bytes[i] = 0;
    return bytes;
}

TEST_F(SecondReader, BmpOfEveryKind) {
    const std::string noise = random_bytes(13 * 7 * 4 + 7 * 4);
    // In files with the oldest header stb does not find the last four colours of the palette.
    std::string low_numbers = noise;
    for (char& byte : low_numbers) byte &= 0x77;
    for (const std::uint32_t bits : {4u, 8u})
        expect_same(bmp(12, bits, {}, low_numbers), "oldest header, " + std::to_string(bits));
    expect_same(bmp(12, 24, {}, noise), "oldest header, 24");
    for (const std::uint32_t header_size : {40u, 108u, 124u}) {
        for (const std::uint32_t bits : {1u, 4u, 8u, 16u, 24u, 32u})
            expect_same(bmp(header_size, bits, {}, noise),
                        "header " + std::to_string(header_size) + ", " + std::to_string(bits));
        expect_same(bmp(header_size, 32, {}, without_fourth_bytes(noise)), "fourth bytes zero");
    }
    // Colours have 5, 6 and 5 bits, fewer bits, and bits in unusual places.
    expect_same(bmp(40, 16, {0xf800, 0x07e0, 0x001f}, noise), "565");
    expect_same(bmp(40, 16, {0x0007, 0x0008, 0x0030}, noise), "312");
    expect_same(bmp(108, 16, {0xf00, 0xf0, 0xf, 0xf000}, noise), "4444");
    expect_same(bmp(108, 32, {0xff, 0xff00, 0xff0000, 0xff000000}, noise), "RGBA");
    expect_same(bmp(124, 32, {0x7f000000, 0xff0000, 0xff00, 0}, noise), "no alpha");
}

TEST_F(SecondReader, CommittedFiles) {
    int count = 0;
    for (const char* folder : {"docs/images", "tests/fuzz/corpus/image", "tests/scene/corpus/textures"})
        for (const auto& entry : std::filesystem::directory_iterator(
                 std::filesystem::path(nusselt_test::kSourceFolder) / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".png" && extension != ".tga" && extension != ".bmp") continue;
            const std::string file = read_bytes(entry.path());
            if (!error_of([&] { (void)fractions(file, 3); }).empty()) continue; // damaged on purpose
            expect_same(file, entry.path().string());
            ++count;
        }
    EXPECT_GT(count, 25);
}

std::string jpg(int width, int height, int channels, J_COLOR_SPACE space, bool is_progressive) {
    jpeg_compress_struct info = {};
    jpeg_error_mgr errors = {};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* buffer = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &buffer, &size);
    info.image_width = JDIMENSION(width);
    info.image_height = JDIMENSION(height);
    info.input_components = channels;
    info.in_color_space = channels == 1 ? JCS_GRAYSCALE : channels == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&info);
    jpeg_set_colorspace(&info, space);
    jpeg_set_quality(&info, 95, TRUE);
    if (is_progressive) jpeg_simple_progression(&info);
    jpeg_start_compress(&info, TRUE);
    std::vector<JSAMPLE> row(std::size_t(width * channels));
    for (int y = 0; y < height; ++y) {
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] =
                static_cast<JSAMPLE>(128 + 100 * std::sin(0.05 * double(i) + 0.1 * y * double(i % 3 + 1)));
        JSAMPROW rows = row.data();
        jpeg_write_scanlines(&info, &rows, 1);
    }
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    std::string file(reinterpret_cast<char*>(buffer), size);
    std::free(buffer);
    return file;
}

// Rounding differs: that of stb adds up to 2 steps, where chroma has half the resolution up to 3.
TEST_F(SecondReader, JpgOfEveryKind) {
    struct Kind {
        int channels;
        J_COLOR_SPACE space;
    };
    for (const Kind kind :
         {Kind{1, JCS_GRAYSCALE}, Kind{3, JCS_YCbCr}, Kind{3, JCS_RGB}, Kind{4, JCS_CMYK}, Kind{4, JCS_YCCK}})
        for (const bool is_progressive : {false, true})
            for (const auto& [width, height] : {std::pair{61, 35}, {8, 8}, {1, 1}}) {
                const std::string file = jpg(width, height, kind.channels, kind.space, is_progressive);
                const int channels = kind.channels == 1 ? 1 : 3;
                ASSERT_EQ(header_of(file).channels, channels);
                const std::vector<float> values = fractions(file, channels).values;
                const std::vector<float> others = fractions_by_stb(file, channels);
                ASSERT_EQ(values.size(), others.size());
                double sum = 0;
                for (std::size_t i = 0; i < values.size(); ++i) {
                    ASSERT_NEAR(values[i], others[i], 3.01 / 255)
                        << kind.space << " " << is_progressive << " " << i;
                    sum += std::fabs(double(values[i]) - double(others[i]));
                }
                EXPECT_LT(sum / double(values.size()), 0.5 / 255) << kind.space << " " << is_progressive;
            }
}

} // namespace

} // namespace nusselt::image::test
