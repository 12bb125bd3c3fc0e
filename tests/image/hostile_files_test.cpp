/// Files that claim more than they hold: they are refused before memory is taken for what they claim.

#include "image/coded_file.h"
#include "image/io.h"
#include "image/layers.h"
#include "image_fixture.h"
#include "png_chunks.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <stb/stb_image_write.h>
#include <zlib.h>

#include <sstream>

namespace nusselt::image::test {

namespace {

class HostileFiles : public ImageTest {
protected:
    std::string error_of_reading(const std::string& name, const std::string& contents) const {
        write_bytes(in_folder(name), contents);
        return error_of([&] { (void)read_image(in_folder(name)); });
    }

    void expect_cut_off(const std::string& name, const std::string& contents) const {
        const std::string error = error_of_reading(name, contents);
        EXPECT_NE(error.find("truncated"), std::string::npos) << name << ": " << error;
        EXPECT_NE(error.find(name), std::string::npos) << error;
    }

    /// The bytes of an image in one of the formats that stb, another program's library, writes.
    std::string written_by_stb(const std::string& extension) const {
        const std::string path = in_folder("stb" + extension).string();
        std::mt19937 engine(1);
        std::string codes(16 * 8 * 3, '\0');
        for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = i < 100 ? char(engine()) : char(7);
        if (extension == ".jpg") {
            stbi_write_jpg(path.c_str(), 16, 8, 3, codes.data(), 90);
        } else {
            stbi_write_tga(path.c_str(), 16, 8, 3, codes.data());
        }
        return read_bytes(path);
    }
};

std::string deflated(const std::string& data) {
    uLongf size = compressBound(uLong(data.size()));
    std::string packed(size, '\0');
    compress2(reinterpret_cast<unsigned char*>(packed.data()), &size,
              reinterpret_cast<const unsigned char*>(data.data()), uLong(data.size()), 9);
    packed.resize(size);
    return packed;
}

/// A grey PNG. \param bits per pixel, 1, 2, 4, 8 or 16 \param interlaced whether the header claims it
std::string grey_png(int width, int height, char bits, bool interlaced, const std::string& rows) {
    const std::string header = big_endian(std::uint32_t(width)) + big_endian(std::uint32_t(height)) + bits +
                               std::string("\0\0\0", 3) + char(interlaced);
    const std::string packed = deflated(rows);
    // In two pieces, as large files are.
    return "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", header) +
           png_chunk("IDAT", packed.substr(0, packed.size() / 2)) +
           png_chunk("IDAT", packed.substr(packed.size() / 2)) + png_chunk("IEND", "");
}

TEST_F(HostileFiles, PngWithHugeSize) {
    const auto png = [](int width, int height) {
        return grey_png(width, height, 8, false, std::string(70, '\0'));
    };
    EXPECT_EQ(error_of_reading("a.png", png(9, 7)), "");
    expect_cut_off("a.png", png(16384, 16384));
    // 1032 bytes of one are the most that deflate can do: 8 bits of 1000 x 1000 pixels need 970 bytes.
    expect_cut_off("a.png", png(1000, 1000));
    EXPECT_NE(
        error_of_reading("a.png", png(30000, 30000))
            .find("a size of 30000 x 30000 pixels is not supported: it would take 10.8 GB of memory; the "
                  "limit is 2^28 pixels, which take 3.2 GB"),
        std::string::npos);
    std::string damaged = png(9, 7);
    damaged[19] = 8;
    EXPECT_NE(error_of_reading("a.png", damaged).find("IHDR: CRC error"), std::string::npos);
}

TEST_F(HostileFiles, LegalPngOfOneColourIsRead) {
    Image image = make_image(3000, 2000);
    write_image(in_folder("a.png"), image);
    EXPECT_LT(std::filesystem::file_size(in_folder("a.png")), image.pixels.size() / 100);
    EXPECT_EQ(read_image(in_folder("a.png")).pixels, image.pixels);
}

TEST_F(HostileFiles, PngMustHoldItsPixels) {
    const auto zeros = [](std::size_t count) { return std::string(count, '\0'); };
    // Rows of 1 + 250 bytes. Few bytes of deflate could be 2000 x 2000 pixels of one bit; these are one byte less.
    EXPECT_EQ(error_of_reading("a.png", grey_png(2000, 2000, 1, false, zeros(2000 * 251))), "");
    expect_cut_off("a.png", grey_png(2000, 2000, 1, false, zeros(2000 * 251 - 1)));
    // 32 KB, which claim 2^28 pixels but hold as many bytes only.
    expect_cut_off("a.png", grey_png(16384, 16384, 1, false, zeros(std::size_t(1) << 24)));
    EXPECT_EQ(error_of_reading("a.png", grey_png(7, 3, 16, false, zeros(3 * 15))), "");
    expect_cut_off("a.png", grey_png(7, 3, 16, false, zeros(3 * 15 - 1)));
}

TEST_F(HostileFiles, PngInterlacedInSevenPasses) {
    const auto zeros = [](std::size_t count) { return std::string(count, '\0'); };
    // 9 x 9 pixels: passes of 2x2, 1x2, 3x1, 2x3, 5x2, 4x5 and 9x4, with a byte more in each row.
    constexpr std::size_t kSize = 2 * 3 + 2 * 2 + 1 * 4 + 3 * 3 + 2 * 6 + 5 * 5 + 4 * 10;
    EXPECT_EQ(error_of_reading("a.png", grey_png(9, 9, 8, true, zeros(kSize))), "");
    expect_cut_off("a.png", grey_png(9, 9, 8, true, zeros(kSize - 1)));
    // A single pixel has only the first pass.
    EXPECT_EQ(error_of_reading("a.png", grey_png(1, 1, 8, true, zeros(2))), "");
    expect_cut_off("a.png", grey_png(1, 1, 8, true, zeros(1)));
}

// 12 KB of deflate, 12 MB of zeros: what follows the last row is not inflated.
TEST_F(HostileFiles, PngWithMoreThanItsPixels) {
    const std::string png = grey_png(16, 16, 8, false, std::string(12'000'000, '\0'));
    EXPECT_LT(png.size(), 13'000u);
    EXPECT_NE(error_of_reading("a.png", png).find("Too much image data"), std::string::npos);
}

/// A PNG of 2 x 3 pixels with a palette of three colours. \param indices of the pixels
std::string palette_png(const std::string& indices, bool interlaced) {
    const std::string header =
        big_endian(2) + big_endian(3) + std::string("\x08\x03\0\0", 4) + char(interlaced);
    std::string rows;
    // The passes of such a small file: (0, 0); (1, 0) and (0, 2) and (1, 2) in rows of their own; then row 1.
    if (interlaced) {
        for (const std::size_t i : {0u, 4u, 1u, 5u}) rows += std::string(1, '\0') + indices[i];
        rows += '\0' + indices.substr(2, 2);
    } else {
        for (std::size_t y = 0; y < 3; ++y) rows += '\0' + indices.substr(2 * y, 2);
    }
    return "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", header) + png_chunk("PLTE", "abcdefghi") +
           png_chunk("IDAT", deflated(rows)) + png_chunk("IEND", "");
}

TEST_F(HostileFiles, PngWithIndicesBeyondItsPalette) {
    for (const bool interlaced : {false, true}) {
        std::string indices("\0\1\2\0\1\2", 6);
        ASSERT_EQ(error_of_reading("a.png", palette_png(indices, interlaced)), "");
        indices[3] = 3;
        EXPECT_NE(error_of_reading("a.png", palette_png(indices, interlaced))
                      .find("the pixel (1, 1) has the palette index 3, but the palette has only 3 colours"),
                  std::string::npos);
    }
}

// Neither inflated nor mentioned on the standard error output.
TEST_F(HostileFiles, PngWithDamagedTextIsRead) {
    std::string png = grey_png(9, 7, 8, false, std::string(70, '\0'));
    const std::size_t end_of_header = 8 + 25;
    png.insert(end_of_header, png_chunk("zTXt", "key\0\0no deflate") + png_chunk("iCCP", "profile") +
                                  png_chunk("gAMA", big_endian(1)));
    testing::internal::CaptureStderr();
    EXPECT_EQ(error_of_reading("a.png", png), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(HostileFiles, BmpMustHoldItsPixels) {
    // Rows of 3 pixels with 24 bits take 12 bytes.
    const auto bmp = [](std::size_t pixel_bytes) {
        return std::string("BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\3\0\0\0\2\0\0\0\1\0\x18\0", 30) +
               std::string(24, '\0') + std::string(pixel_bytes, '\x40');
    };
    std::istringstream complete(bmp(24));
    const CodedHeader header = read_coded_header(complete);
    EXPECT_EQ(header.width, 3);
    EXPECT_EQ(header.height, 2);
    EXPECT_EQ(decode_codes(complete, 3, [](double code) { return code; }).values,
              std::vector<float>(18, 64 / 255.0f));
    std::istringstream cut_off(bmp(23));
    EXPECT_NE(error_of([&] { (void)read_coded_header(cut_off); }).find("truncated"), std::string::npos);
}

/// A progressive file of 8 x 8 grey pixels, all but the first scan of which change nothing.
std::string jpg_of_scans(int count) {
    // One table for each kind of coefficients, whose only code is the bit 0: no difference, or the end of the block.
    const std::string table = std::string("\x01", 1) + std::string(15, '\0') + '\0';
    const auto segment = [](char mark, const std::string& data) {
        return std::string("\xFF") + mark + big_endian(std::uint32_t(data.size() + 2)).substr(2) + data;
    };
    const auto scan = [&](char first, char last, char bits) {
        // One bit of the code, and ones up to the end of the byte.
        return segment('\xDA', std::string("\1\1\0", 3) + first + last + bits) + "\x7F";
    };
    std::string jpg = "\xFF\xD8" + segment('\xDB', std::string(1, '\0') + std::string(64, '\1')) +
                      segment('\xC2', std::string("\x08\0\x08\0\x08\1\1\x11\0", 9)) +
                      segment('\xC4', '\0' + table) + segment('\xC4', '\x10' + table) + scan(0, 0, 0);
    for (int i = 1; i < count; ++i) jpg += scan(1, 63, 0);
    return jpg + "\xFF\xD9";
}

TEST_F(HostileFiles, JpgCutOffOrHuge) {
    const std::string jpg = written_by_stb(".jpg");
    EXPECT_EQ(error_of_reading("a.jpg", jpg), "");
    for (std::size_t length = 2; length < jpg.size(); length += 7)
        EXPECT_NE(error_of_reading("a.jpg", jpg.substr(0, length)), "") << length;
    expect_cut_off("a.jpg", jpg.substr(0, jpg.size() - 1));
    std::string huge = jpg;
    const std::size_t frame = jpg.find("\xFF\xC0");
    ASSERT_NE(frame, std::string::npos);
    huge.replace(frame + 5, 4, "\x3F\xFF\x3F\xFF");
    expect_cut_off("a.jpg", huge);
}

// A decoder would guess pixels, and report it on the standard error output.
TEST_F(HostileFiles, DamagedJpgIsRefused) {
    std::string jpg = written_by_stb(".jpg");
    const std::size_t scan = jpg.find("\xFF\xDA");
    ASSERT_NE(scan, std::string::npos);
    jpg.replace(scan + 20, 2, "\xFF\xD9");
    testing::internal::CaptureStderr();
    EXPECT_NE(error_of_reading("a.jpg", jpg).find("premature end of data segment"), std::string::npos);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// Each of its scans goes over the whole image, but takes a few bytes.
TEST_F(HostileFiles, JpgWithVeryManyScans) {
    const auto error_of_scans = [&](int count) { return error_of_reading("a.jpg", jpg_of_scans(count)); };
    EXPECT_EQ(error_of_scans(500), "");
    EXPECT_NE(error_of_scans(501).find("more than 500 scans"), std::string::npos);
}

TEST_F(HostileFiles, TgaCutOffOrHuge) {
    stbi_write_tga_with_rle = 1;
    const std::string runs = written_by_stb(".tga");
    stbi_write_tga_with_rle = 0;
    const std::string plain = written_by_stb(".tga");
    ASSERT_LT(runs.size(), plain.size());
    for (const std::string& tga : {runs, plain}) {
        EXPECT_EQ(error_of_reading("a.tga", tga), "");
        for (std::size_t length = 0; length < tga.size(); ++length)
            ASSERT_NE(error_of_reading("a.tga", tga.substr(0, length)), "") << length << " of " << tga.size();
        std::string huge = tga;
        huge.replace(12, 4, "\xFF\x3F\xFF\x3F");
        expect_cut_off("a.tga", huge);
    }
}

TEST_F(HostileFiles, HdrIsDividedByExposures) {
    const auto red = [&](const std::string& lines) {
        write_bytes(in_folder("a.hdr"),
                    "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x84");
        return read_image(in_folder("a.hdr")).pixels;
    };
    const std::vector<float> stored = red("");
    EXPECT_EQ(stored, (std::vector<float>{8, 4, 2}));
    EXPECT_EQ(red("EXPOSURE=2\n"), (std::vector<float>{4, 2, 1}));
    EXPECT_EQ(red("EXPOSURE= 2.0e+00\nEXPOSURE=0.125\n"), (std::vector<float>{32, 16, 8}));
    EXPECT_EQ(red("COLORCORR=1 2 0.5\nEXPOSURE=2\n"), (std::vector<float>{4, 1, 2}));
    for (const std::string line : {"EXPOSURE=", "EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=nan", "EXPOSURE=1,5",
                                   "COLORCORR=1 2", "COLORCORR=1 2 3 4"}) {
        const std::string error = error_of([&] { red(line + "\n"); });
        EXPECT_NE(error.find("'" + line + "' in the header must have"), std::string::npos) << error;
    }
}

/// Headers that an editor of another system has saved.
TEST_F(HostileFiles, HdrWithDosLineEnds) {
    write_bytes(in_folder("a.hdr"), "#?RADIANCE\r\nEXPOSURE=2\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n"
                                    "-Y 1 +X 1\r\n\x80\x40\x20\x84");
    EXPECT_EQ(read_image(in_folder("a.hdr")).pixels, (std::vector<float>{4, 2, 1}));
}

TEST_F(HostileFiles, HdrWithHugeSize) {
    for (const std::string size : {"-Y 16384 +X 16384", "-Y 1 +X 268435456", "-Y 268435456 +X 1"})
        expect_cut_off("a.hdr",
                       "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + std::string(1000, '\1'));
}

TEST_F(HostileFiles, OtherFormatsAreRefused) {
    // A bitmap of one pixel.
    const std::string bmp =
        std::string("BM\x3A\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18\0", 30) +
        std::string(28, '\0');
    EXPECT_NE(error_of_reading("a.png", bmp).find("this is a BMP file"), std::string::npos);
    EXPECT_NE(error_of_reading("a.png", "P6 1 1 255\nabc").find("does not begin like PNG"),
              std::string::npos);
}

TEST_F(HostileFiles, MessagesOfTgaSayWhatIsWrong) {
    const auto error_of_tga = [&](std::size_t place, char byte) {
        // A grey image of 2 x 1 pixels.
        std::string tga("\0\0\3\0\0\0\0\0\0\0\0\0\2\0\1\0\10\0gg", 20);
        tga[place] = byte;
        return error_of_reading("a.tga", tga);
    };
    EXPECT_EQ(error_of_tga(0, 0), "");
    const std::pair<std::string, std::string> kErrors[] = {
        {error_of_tga(1, 1), "its colour map type is 1, but must be 0 for the image type 3"},
        {error_of_tga(2, 4), "its image type is 4, but must be 1, 2 or 3"},
        {error_of_tga(2, 1), "its colour map type is 0, but must be 1 for the image type 1"},
        {error_of_tga(12, 0), "its size is 0 x 1 pixels"},
        {error_of_tga(16, 12), "it has 12 bits per pixel; 8, 15, 16, 24 and 32 are supported"},
        {error_of_reading("a.tga", "short"), "it has only 5 bytes, but its header would have 18"},
    };
    for (const auto& [error, problem] : kErrors)
        EXPECT_NE(error.find(problem), std::string::npos) << problem << " is missing in: " << error;
}

TEST_F(HostileFiles, MessagesOfBmpSayWhatIsWrong) {
    const auto error_of_bmp = [&](std::size_t place, char byte) {
        std::string bmp =
            std::string("BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18\0", 30) +
            std::string(28, '\0');
        bmp[place] = byte;
        std::istringstream stream(bmp);
        return error_of([&] { (void)read_coded_header(stream); });
    };
    EXPECT_EQ(error_of_bmp(0, 'B'), "");
    EXPECT_NE(error_of_bmp(14, 20).find("header of 20 bytes; headers of 12 bytes and of 40"),
              std::string::npos);
    EXPECT_NE(error_of_bmp(30, 1).find("24 bits per pixel and the compression 1; the compressions 0"),
              std::string::npos);
    EXPECT_NE(error_of_bmp(28, 2).find("has 2 bits per pixel; 1, 4, 8"), std::string::npos);
}

TEST_F(HostileFiles, MessagesOfExrNameTheFileOnce) {
    write_image(in_folder("good.exr"), random_image(9, 7, 1));
    const std::string good = read_bytes(in_folder("good.exr"));
    int opened = 0;
    for (std::size_t length = 1; length < good.size(); length += 5) {
        const std::string error = error_of_reading("a.exr", good.substr(0, length));
        ASSERT_NE(error, "");
        EXPECT_EQ(error.find("a.exr"), error.rfind("a.exr")) << error;
        EXPECT_EQ(error.find("image file"), std::string::npos) << error;
        if (error.find("cannot decode its EXR data (") != std::string::npos) ++opened;
    }
    EXPECT_GT(opened, 0) << "no message of OpenEXR";
}

/// The attribute's value begins after name, type and size.
std::string with_data_window(std::string exr, std::int32_t right, std::int32_t bottom) {
    const std::size_t begin = exr.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4 + 8;
    for (int i = 0; i < 4; ++i) {
        exr[begin + std::size_t(i)] = char(right >> (8 * i));
        exr[begin + 4 + std::size_t(i)] = char(bottom >> (8 * i));
    }
    return exr;
}

TEST_F(HostileFiles, ExrWithHugeAttribute) {
    write_image(in_folder("good.exr"), random_image(9, 7, 1), {{"scene", "room"}});
    const std::string good = read_bytes(in_folder("good.exr"));
    const std::string name("nusselt:scene\0string\0", 21);
    const std::size_t size = good.find(name) + name.size();
    for (const std::string& claimed :
         {std::string("\xFF\xFF\xFF\x7F"), std::string("\0\0\0\x80", 4), std::string("\xFF\xFF\0\0", 4)}) {
        std::string hostile = good;
        hostile.replace(size, 4, claimed);
        expect_cut_off("a.exr", hostile);
        EXPECT_NE(error_of([&] { (void)read_exr_metadata(in_folder("a.exr")); }), "");
        EXPECT_NE(error_of([&] { (void)read_layer_list(in_folder("a.exr")); }), "");
    }
}

TEST_F(HostileFiles, ExrOfSeveralPartsIsRead) {
    std::vector<float> values(63, 2.5f);
    std::vector<Imf::Header> headers;
    for (const char* name : {"first", "second"}) {
        Imf::Header header(9, 7);
        header.setName(name);
        header.setType(Imf::SCANLINEIMAGE);
        header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
        headers.push_back(header);
    }
    {
        Imf::MultiPartOutputFile file(in_folder("a.exr").c_str(), headers.data(), 2);
        for (int i = 0; i < 2; ++i) {
            Imf::OutputPart part(file, i);
            Imf::FrameBuffer frame_buffer;
            frame_buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), headers[0].dataWindow()));
            part.setFrameBuffer(frame_buffer);
            part.writePixels(7);
            values.assign(63, -1);
        }
    }
    EXPECT_EQ(read_image(in_folder("a.exr")).pixels, std::vector<float>(189, 2.5f));
}

TEST_F(HostileFiles, CompressedExrWithHugeRows) {
    for (const Imf::Compression compression :
         {Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
          Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION}) {
        Imf::Header header(9, 7);
        header.compression() = compression;
        std::vector<half> values(63);
        Imf::FrameBuffer frame_buffer;
        for (const char* channel : {"R", "G", "B"}) {
            header.channels().insert(channel, Imf::Channel(Imf::HALF));
            frame_buffer.insert(channel, Imf::Slice::Make(Imf::HALF, values.data(), header.dataWindow()));
        }
        {
            Imf::OutputFile file(in_folder("good.exr").c_str(), header);
            file.setFrameBuffer(frame_buffer);
            file.writePixels(7);
        }
        const std::string good = read_bytes(in_folder("good.exr"));
        EXPECT_EQ(error_of_reading("a.exr", with_data_window(good, 8, 6)), "");
        expect_cut_off("a.exr", with_data_window(good, (1 << 25) - 1, 6));
        write_bytes(in_folder("a.exr"), with_data_window(good, (1 << 25) - 1, 6));
        EXPECT_NE(error_of([&] { (void)read_layers(in_folder("a.exr")); }), "");
    }
}

// 256 rows are decoded at once. What one byte stands for at most does not refuse the file: 8 x 8 pixels are two bytes
// before deflate.
TEST_F(HostileFiles, ExrOfFewRowsInHugeChunks) {
    Imf::Header header(9, 7);
    header.compression() = Imf::DWAB_COMPRESSION;
    std::vector<float> values(63);
    Imf::FrameBuffer frame_buffer;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    frame_buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
    {
        Imf::OutputFile file(in_folder("good.exr").c_str(), header);
        file.setFrameBuffer(frame_buffer);
        file.writePixels(7);
    }
    const std::string good = read_bytes(in_folder("good.exr"));
    EXPECT_EQ(error_of_reading("a.exr", good), "");
    // 4 bytes in 256 rows of 2^17 pixels are the limit.
    EXPECT_EQ(error_of_reading("a.exr", with_data_window(good, (1 << 17) - 1, 6)).find("rows of"),
              std::string::npos);
    EXPECT_NE(error_of_reading("a.exr", with_data_window(good, 1 << 17, 6)).find("rows of 131073 pixels"),
              std::string::npos);
}

TEST_F(HostileFiles, ExrWithHugeTiles) {
    Imf::Header header(9, 7);
    header.setTileDescription(Imf::TileDescription(16, 16, Imf::ONE_LEVEL));
    header.compression() = Imf::ZIP_COMPRESSION;
    std::vector<float> values(63);
    Imf::FrameBuffer frame_buffer;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    frame_buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow()));
    {
        Imf::TiledOutputFile file(in_folder("good.exr").c_str(), header);
        file.setFrameBuffer(frame_buffer);
        file.writeTile(0, 0);
    }
    std::string tiles = read_bytes(in_folder("good.exr"));
    EXPECT_EQ(error_of_reading("a.exr", tiles), "");
    const std::size_t size = tiles.find(std::string("tiledesc\0", 9)) + 9 + 4;
    tiles.replace(size, 8, std::string("\0\x20\0\0\0\x20\0\0", 8)); // 8192 x 8192
    EXPECT_NE(error_of_reading("a.exr", tiles).find("tiles of 8192 x 8192"), std::string::npos);
}

} // namespace

} // namespace nusselt::image::test
