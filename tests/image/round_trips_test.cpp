#include "image/io.h"
#include "image/srgb.h"
#include "image_fixture.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace nusselt::image::test {

namespace {

using RoundTrip = ImageTest;

std::vector<std::uint32_t> bits(const Image& image) {
    std::vector<std::uint32_t> result;
    for (const float value : image.pixels) result.push_back(std::bit_cast<std::uint32_t>(value));
    return result;
}

/// Writes the named channels through OpenEXR itself; all channels hold the red channel of the image.
void write_foreign_exr(const std::filesystem::path& path, const Image& image, Imf::Header header,
                       Imf::PixelType type, const std::vector<std::string>& channels) {
    std::vector<half> halves;
    for (const float value : image.pixels) halves.push_back(half(value));
    const void* data = type == Imf::HALF ? static_cast<const void*>(halves.data()) : image.pixels.data();
    const std::size_t stride = 3 * (type == Imf::HALF ? sizeof(half) : sizeof(float));
    Imf::FrameBuffer frame_buffer;
    for (const std::string& channel : channels) {
        header.channels().insert(channel, Imf::Channel(type));
        frame_buffer.insert(channel, Imf::Slice::Make(type, data, header.dataWindow(), stride,
                                                      stride * std::size_t(image.width)));
    }
    if (header.hasTileDescription()) {
        Imf::TiledOutputFile file(path.string().c_str(), header);
        file.setFrameBuffer(frame_buffer);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(path.string().c_str(), header);
        file.setFrameBuffer(frame_buffer);
        file.writePixels(image.height);
    }
}

TEST_F(RoundTrip, ExrIsBitExactForEveryClassOfFloat) {
    using Limits = std::numeric_limits<float>;
    Image image = random_image(37, 23, 1);
    const std::vector<float> special = {Limits::infinity(),
                                        -Limits::infinity(),
                                        Limits::quiet_NaN(),
                                        Limits::denorm_min(),
                                        -Limits::denorm_min(),
                                        Limits::min() / 3,
                                        Limits::max(),
                                        Limits::lowest(),
                                        0.0f,
                                        -0.0f};
    std::copy(special.begin(), special.end(), image.pixels.begin() + 100);
    image.pixels[200] = std::bit_cast<float>(0x7fc12345u); // NaN with a payload
    write_image(in_folder("a.exr"), image);
    const Image read = read_image(in_folder("a.exr"));
    EXPECT_EQ(read.width, 37);
    EXPECT_EQ(read.height, 23);
    EXPECT_EQ(bits(read), bits(image));
}

TEST_F(RoundTrip, ExrOfOnePixelAndOfLongRows) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 500}, {5000, 1}}) {
        const Image image = random_image(width, height, 2);
        write_image(in_folder("a.EXR"), image);
        EXPECT_EQ(bits(read_image(in_folder("a.EXR"))), bits(image)) << width << " x " << height;
    }
}

TEST_F(RoundTrip, ExrKeepsMetadata) {
    const Metadata metadata = {{"spp", "16"},
                               {"technique", "line projected solid angle"},
                               {"empty", ""},
                               {"command line", "nusselt render --spp 16 \"a b\"\nsecond line \xc3\xa4"},
                               {std::string(200, 'k'), std::string(100000, 'v')}};
    write_image(in_folder("a.exr"), random_image(4, 4, 3), metadata);
    EXPECT_EQ(read_exr_metadata(in_folder("a.exr")), metadata);
}

TEST_F(RoundTrip, MetadataOfForeignFilesAreEmpty) {
    const Image image = random_image(4, 4, 3);
    write_foreign_exr(in_folder("a.exr"), image, Imf::Header(4, 4), Imf::FLOAT, {"R", "G", "B"});
    EXPECT_TRUE(read_exr_metadata(in_folder("a.exr")).empty());
}

TEST_F(RoundTrip, MetadataKeysAreChecked) {
    const Image image = random_image(2, 2, 3);
    for (const std::string& key : {std::string(), std::string(201, 'k'), std::string("a\0b", 3)})
        EXPECT_THROW(write_image(in_folder("a.exr"), image, {{key, "v"}}), std::invalid_argument);
    EXPECT_TRUE(file_names().empty());
}

TEST_F(RoundTrip, ForeignExrInEveryLosslessCompression) {
    const Image image = random_image(70, 45, 4);
    for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                   Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
        Imf::Header header(70, 45);
        header.compression() = compression;
        write_foreign_exr(in_folder("a.exr"), image, header, Imf::FLOAT, {"R", "G", "B", "A", "normal.X"});
        const Image read = read_image(in_folder("a.exr"));
        ASSERT_EQ(read.pixels.size(), image.pixels.size());
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            ASSERT_EQ(read.pixels[i], image.pixels[i - i % 3]) << "compression " << compression;
    }
}

TEST_F(RoundTrip, ExrHalfAndTilesAndGreyAndShiftedDataWindow) {
    const Image image = random_image(70, 45, 5);
    Imf::Header header(Imath::Box2i({0, 0}, {199, 99}), Imath::Box2i({-20, 30}, {49, 74}));
    header.setTileDescription(Imf::TileDescription(16, 16, Imf::ONE_LEVEL));
    write_foreign_exr(in_folder("a.exr"), image, header, Imf::HALF, {"Y"});
    const Image read = read_image(in_folder("a.exr"));
    ASSERT_EQ(read.width, 70);
    ASSERT_EQ(read.height, 45);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        ASSERT_EQ(read.pixels[i], float(half(image.pixels[i - i % 3])));
}

TEST_F(RoundTrip, ExrWithoutColoursNamesTheChannelsThatItHas) {
    const Image image = random_image(4, 4, 6);
    for (const std::vector<std::string>& channels :
         {std::vector<std::string>{"R", "G"}, {"depth.Z", "A"}, {"BY", "RY", "Y"}}) {
        write_foreign_exr(in_folder("a.exr"), image, Imf::Header(4, 4), Imf::FLOAT, channels);
        const std::string error = error_of([&] { (void)read_image(in_folder("a.exr")); });
        EXPECT_NE(error.find(in_folder("a.exr").string()), std::string::npos) << error;
        for (const std::string& channel : channels)
            EXPECT_NE(error.find(channel), std::string::npos) << error;
    }
}

/// All values in and around the range that PNG can hold.
Image ramp() {
    Image image = make_image(256, 5);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = float(i) / float(image.pixels.size() - 1) * 1.2f - 0.1f;
    return image;
}

TEST_F(RoundTrip, PngIsWithinHalfACodeValue) {
    const Image image = ramp();
    write_image(in_folder("a.png"), image);
    const Image read = read_image(in_folder("a.png"));
    ASSERT_EQ(read.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const double expected = 255 * srgb_from_linear(std::clamp(double(image.pixels[i]), 0.0, 1.0));
        const double code = 255 * srgb_from_linear(double(read.pixels[i]));
        ASSERT_NEAR(code, expected, 0.5 + 1e-4) << image.pixels[i];
    }
}

TEST_F(RoundTrip, PngCodesAreKnown) {
    // Computed by hand from the definition of sRGB: 0.2158605 is the linear value of the code 128.
    Image image = make_image(3, 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    image.pixels = {0.0f, 1.0f, 0.5f, 0.001f, 0.0031308f, 0.2158605f, nan, infinity, -infinity};
    write_image(in_folder("a.png"), image);
    int width = 0, height = 0, channels = 0;
    unsigned char* codes = stbi_load(in_folder("a.png").string().c_str(), &width, &height, &channels, 0);
    ASSERT_NE(codes, nullptr);
    EXPECT_EQ(channels, 3);
    EXPECT_EQ(std::vector<int>(codes, codes + 9), (std::vector<int>{0, 255, 188, 3, 10, 128, 0, 255, 0}));
    stbi_image_free(codes);
}

TEST_F(RoundTrip, PngExposureIsInStops) {
    Image image = random_image(20, 10, 7);
    for (float& value : image.pixels) value = std::min(value, 4.0f);
    write_image(in_folder("exposed.png"), image, {}, -2);
    for (float& value : image.pixels) value /= 4;
    write_image(in_folder("scaled.png"), image);
    EXPECT_EQ(read_bytes(in_folder("exposed.png")), read_bytes(in_folder("scaled.png")));
}

TEST_F(RoundTrip, Png16BitIsReadWithAllItsBits) {
    // 1 x 1, 16 bit RGB (0x0101, 0x8001, 0xffff), made by hand: signature, IHDR, stored deflate block, IEND.
    const std::string bytes(
        "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x10\2\0\0\0\xc0\xe7\x8f\x9d"
        "\0\0\0\x12IDAT\x78\1\1\7\0\xf8\xff\0\1\1\x80\1\xff\xff\5\x12\2\x82\xed\x72\xd6\xdb"
        "\0\0\0\0IEND\xae\x42\x60\x82",
        8 + 25 + 30 + 12);
    write_bytes(in_folder("a.png"), bytes);
    const Image read = read_image(in_folder("a.png"));
    ASSERT_EQ(read.pixels.size(), 3u);
    EXPECT_FLOAT_EQ(read.pixels[0], float(linear_from_srgb(257 / 65535.0)));
    EXPECT_FLOAT_EQ(read.pixels[1], float(linear_from_srgb(32769 / 65535.0)));
    EXPECT_EQ(read.pixels[2], 1.0f);
}

TEST_F(RoundTrip, JpgAndTgaAreLinearised) {
    const std::vector<unsigned char> codes(16 * 16 * 3, 188);
    ASSERT_NE(stbi_write_tga(in_folder("a.tga").string().c_str(), 16, 16, 3, codes.data()), 0);
    ASSERT_NE(stbi_write_jpg(in_folder("a.jpg").string().c_str(), 16, 16, 3, codes.data(), 100), 0);
    for (const float value : read_image(in_folder("a.tga")).pixels)
        ASSERT_FLOAT_EQ(value, float(std::pow((188 / 255.0 + 0.055) / 1.055, 2.4)));
    for (const float value : read_image(in_folder("a.jpg")).pixels)
        ASSERT_NEAR(255 * srgb_from_linear(double(value)), 188, 1.01);
}

/// Half a step of an 8-bit mantissa, relative to the largest channel.
void expect_close_to_rgbe(const Image& read, const Image& image, float relative_error) {
    ASSERT_EQ(read.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        const float largest = *std::max_element(&image.pixels[i], &image.pixels[i] + 3);
        for (std::size_t c = 0; c < 3; ++c)
            ASSERT_NEAR(read.pixels[i + c], image.pixels[i + c], relative_error * largest) << i;
    }
}

Image image_with_many_exponents() {
    Image image = random_image(61, 47, 8);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = std::ldexp(image.pixels[i], int(i / 3 % 201) - 100);
    return image;
}

TEST_F(RoundTrip, HdrIsWithinHalfAStepOfItsMantissa) {
    const Image image = image_with_many_exponents();
    write_image(in_folder("a.hdr"), image);
    expect_close_to_rgbe(read_image(in_folder("a.hdr")), image, 1.0f / 256);
}

TEST_F(RoundTrip, HdrValuesAreKnown) {
    Image image = make_image(5, 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    image.pixels = {1.0f, 0.5f,   0.25f, nan,  -1.0f,   2.0f, infinity, 0.0f,
                    0.0f, 1e-39f, 0.0f,  0.0f, 255.75f, 1.0f, 3.0f};
    write_image(in_folder("a.hdr"), image);
    // 255.75 rounds up to 256, so that the step of its pixel becomes 2 and 1 and 3 are rounded to even steps.
    EXPECT_EQ(read_image(in_folder("a.hdr")).pixels,
              (std::vector<float>{1.0f, 0.5f, 0.25f, 0.0f, 0.0f, 2.0f, 0xFFp+119f, 0.0f, 0.0f, 0.0f, 0.0f,
                                  0.0f, 256.0f, 0.0f, 4.0f}));
}

TEST_F(RoundTrip, HdrIsUnderstoodByAnotherReader) {
    const Image image = image_with_many_exponents();
    write_image(in_folder("a.hdr"), image);
    int width = 0, height = 0, channels = 0;
    float* values = stbi_loadf(in_folder("a.hdr").string().c_str(), &width, &height, &channels, 3);
    ASSERT_NE(values, nullptr) << stbi_failure_reason();
    ASSERT_EQ(width, image.width);
    ASSERT_EQ(height, image.height);
    EXPECT_EQ(std::vector<float>(values, values + image.pixels.size()),
              read_image(in_folder("a.hdr")).pixels);
    stbi_image_free(values);
}

TEST_F(RoundTrip, HdrWithRunLengthsOfAnotherWriter) {
    Image image = random_image(300, 20, 9);
    std::fill(image.pixels.begin() + 300, image.pixels.begin() + 1700, 0.25f);
    ASSERT_NE(stbi_write_hdr(in_folder("a.hdr").string().c_str(), 300, 20, 3, image.pixels.data()), 0);
    ASSERT_LT(std::filesystem::file_size(in_folder("a.hdr")), 4u * 300 * 20) << "no run lengths were used";
    expect_close_to_rgbe(read_image(in_folder("a.hdr")), image, 1.0f / 128); // this writer truncates
}

} // namespace

} // namespace nusselt::image::test
