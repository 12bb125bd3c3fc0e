/// The memory that images take while they are read and converted, and what happens where there is too little.

#include "apps/nusselt/image/convert.h"
#include "common/process_memory.h"
#include "image/coded_file.h"
#include "image/io.h"
#include "image/layers.h"
#include "image_fixture.h"
#include "png_chunks.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <zlib.h>

#include <cstdio> // jpeglib.h needs it

#include <jpeglib.h>
#include <png.h>

#include <ctime>
#include <malloc.h>
#include <sys/resource.h>

namespace nusselt::image::test {

namespace {

// Arrays that double would take up to twice as much for a size like this.
constexpr int kWidth = 2100, kHeight = 1400;
constexpr double kFloatBytes = 3.0 * sizeof(float) * kWidth * kHeight;
/// What libraries and buffers take, whatever the size of the image.
constexpr double kConstantBytes = 6e6;

/// Peaks of this process. Linux keeps the largest memory in use since the last reset.
class PeakMemory {
public:
    PeakMemory() {
        malloc_trim(0);
        std::ofstream("/proc/self/clear_refs") << "5\n";
        begin_ = nusselt_test::process_memory("VmRSS");
    }

    /// Since the object was made.
    double bytes() const { return nusselt_test::process_memory("VmHWM") - begin_; }

    /// Sanitizers keep memory that was freed, and some systems do not know the reset.
    static bool is_measurable() {
        if (nusselt_test::kHasSanitizer) return false;
        { const std::vector<char> touched(std::size_t(1) << 26, 'x'); }
        return PeakMemory().bytes() < double(1 << 25);
    }

private:
    double begin_ = 0;
};

class Memory : public ImageTest {
protected:
    void SetUp() override {
        if (!PeakMemory::is_measurable()) GTEST_SKIP() << "the peak of memory cannot be measured here";
    }

    double peak_of_reading(const std::string& name) const {
        const PeakMemory peak;
        const Image image = read_image(in_folder(name));
        EXPECT_EQ(image.width, kWidth);
        EXPECT_EQ(image.height, kHeight);
        return peak.bytes();
    }

    void expect_small_peak_of_reading(const std::string& name) const {
        EXPECT_LT(peak_of_reading(name), 1.5 * kFloatBytes + kConstantBytes) << name;
    }
};

/// Noise, which does not compress. \param format of libpng's simplified interface
void write_png(const std::filesystem::path& path, int format, int bytes_per_pixel, bool is_opaque) {
    std::mt19937 engine(1);
    std::string codes(std::size_t(bytes_per_pixel) * kWidth * kHeight, '\0');
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = is_opaque && i % std::size_t(bytes_per_pixel) == std::size_t(bytes_per_pixel) - 1
                       ? '\xFF'
                       : char(engine() >> 16);
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = kWidth;
    image.height = kHeight;
    image.format = png_uint_32(format);
    image.flags = PNG_IMAGE_FLAG_FAST;
    ASSERT_NE(png_image_write_to_file(&image, path.c_str(), 0, codes.data(), 0, nullptr), 0) << image.message;
}

/// Progressive, without subsampling: libjpeg keeps the coefficients of all pixels.
void write_progressive_jpg(const std::filesystem::path& path) {
    jpeg_compress_struct info = {};
    jpeg_error_mgr errors = {};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    std::FILE* file = std::fopen(path.c_str(), "wb");
    jpeg_stdio_dest(&info, file);
    info.image_width = kWidth;
    info.image_height = kHeight;
    info.input_components = 3;
    info.in_color_space = JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_colorspace(&info, JCS_RGB);
    jpeg_simple_progression(&info);
    jpeg_start_compress(&info, TRUE);
    std::vector<JSAMPLE> row(3 * std::size_t(kWidth));
    for (int y = 0; y < kHeight; ++y) {
        std::fill(row.begin(), row.end(), JSAMPLE(y / 8 % 256));
        JSAMPROW rows = row.data();
        jpeg_write_scanlines(&info, &rows, 1);
    }
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    std::fclose(file);
}

void write_tiled_exr(const std::filesystem::path& path, const Image& image) {
    Imf::Header header(kWidth, kHeight);
    header.setTileDescription(Imf::TileDescription(64, 64, Imf::ONE_LEVEL));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame_buffer;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::string channel(1, "RGB"[c]);
        header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
        frame_buffer.insert(channel,
                            Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, header.dataWindow(),
                                             3 * sizeof(float), 3 * sizeof(float) * kWidth));
    }
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame_buffer);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
}

/// Uncompressed colour. \param bits per pixel
std::string tga_header(char bits) {
    return {0,
            0,
            2,
            0,
            0,
            0,
            0,
            0,
            0,
            0,
            0,
            0,
            char(kWidth % 256),
            char(kWidth / 256),
            char(kHeight % 256),
            char(kHeight / 256),
            bits,
            0};
}

TEST_F(Memory, ReadingFloats) {
    const Image image = random_image(kWidth, kHeight, 1);
    for (const std::string name : {"a.pfm", "a.hdr", "a.exr"}) {
        write_image(in_folder(name), image);
        expect_small_peak_of_reading(name);
    }
}

TEST_F(Memory, ReadingTiles) {
    write_tiled_exr(in_folder("a.exr"), make_image(kWidth, kHeight));
    expect_small_peak_of_reading("a.exr");
}

TEST_F(Memory, ReadingCodes) {
    write_png(in_folder("rgb.png"), PNG_FORMAT_RGB, 3, false);
    write_png(in_folder("rgba16.png"), PNG_FORMAT_LINEAR_RGB_ALPHA, 8, false);
    write_progressive_jpg(in_folder("a.jpg"));
    write_bytes(in_folder("a.tga"), tga_header(32) + std::string(4 * std::size_t(kWidth) * kHeight, 'x'));
    for (const std::string name : {"rgb.png", "rgba16.png", "a.jpg", "a.tga"})
        expect_small_peak_of_reading(name);
}

TEST_F(Memory, AlphaThatIsOpaqueTakesNone) {
    write_png(in_folder("a.png"), PNG_FORMAT_RGBA, 4, true);
    std::ifstream file(in_folder("a.png"), std::ios::binary);
    const PeakMemory peak;
    const Texels texels = decode_codes(file, 4, [](double code) { return code; });
    EXPECT_EQ(texels.channels, 3);
    EXPECT_LT(peak.bytes(), 1.1 * kFloatBytes + kConstantBytes);
}

TEST_F(Memory, Converting) {
    const Image image = random_image(kWidth, kHeight, 1);
    LayeredImage layers{{0, 0, kWidth, kHeight}, {0, 0, kWidth, kHeight}, {}, {}, {}};
    for (const std::string name : {"", "a", "b", "c"}) {
        layers.layers.push_back(color_layer(image));
        layers.layers.back().name = name;
    }
    write_layers(in_folder("layers.exr"), layers);
    layers = {};
    write_png(in_folder("in.png"), PNG_FORMAT_RGB, 3, false);
    const auto peak_of_converting = [&](const std::string& from, const std::string& to,
                                        const std::optional<std::string>& layer) {
        app::ConvertOptions options;
        options.input = in_folder(from);
        options.output = in_folder(to);
        options.layer = layer;
        const PeakMemory peak;
        app::run_convert(options);
        return peak.bytes();
    };
    for (const std::string to : {"out.exr", "out.hdr", "out.pfm"})
        EXPECT_LT(peak_of_converting("in.png", to, {}), 1.5 * kFloatBytes + kConstantBytes) << to;
    EXPECT_LT(peak_of_converting("layers.exr", "out.exr", {}), 1.5 * kFloatBytes + kConstantBytes);
    EXPECT_LT(peak_of_converting("layers.exr", "out.exr", "b"), 1.5 * kFloatBytes + kConstantBytes);
}

/// 4 MiB of zeros as a piece of deflate, which may be repeated.
std::string deflated_zeros() {
    const std::string zeros(std::size_t(1) << 22, '\0');
    std::string packed(1 << 16, '\0');
    z_stream stream = {};
    deflateInit2(&stream, 9, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY);
    stream.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(zeros.data()));
    stream.avail_in = uInt(zeros.size());
    stream.next_out = reinterpret_cast<unsigned char*>(packed.data());
    stream.avail_out = uInt(packed.size());
    deflate(&stream, Z_FULL_FLUSH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

// 16 x 16 pixels, but 12 GB of zeros in 12 MB of deflate. Neither memory nor time go into what follows the last row.
TEST_F(Memory, PngWithGigabytesBehindItsPixels) {
    const std::string header = big_endian(16) + big_endian(16) + std::string("\x08\0\0\0\0", 5);
    const std::string begin = "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", header);
    const std::string zeros = deflated_zeros();
    const int count = int(12'000'000 / zeros.size());
    std::string one = "\x78\x01", chunks = png_chunk("IDAT", one);
    for (int i = 0; i < count; ++i) {
        one += zeros;
        chunks += png_chunk("IDAT", zeros);
    }
    ASSERT_GT(one.size(), 11'900'000u);
    write_bytes(in_folder("one.png"), begin + png_chunk("IDAT", one) + png_chunk("IEND", ""));
    write_bytes(in_folder("chunks.png"), begin + chunks + png_chunk("IEND", ""));
    for (const auto& [name, problem] :
         {std::pair<std::string, std::string>("one.png", "chunk data is too large"),
          {"chunks.png", "Too much image data"}}) {
        const PeakMemory peak;
        const std::clock_t start = std::clock(); // of the processor, whatever else runs on it
        const std::string error = error_of([&, name = name] { (void)read_image(in_folder(name)); });
        EXPECT_NE(error.find(problem), std::string::npos) << error;
        EXPECT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, 0.5) << name;
        EXPECT_LT(peak.bytes(), 2e6) << name;
    }
}

/// Lets this process have only so much more address space.
class MemoryLimit {
public:
    explicit MemoryLimit(double more_bytes) {
        ::getrlimit(RLIMIT_AS, &old_);
        const rlimit limit = {rlim_t(nusselt_test::process_memory("VmSize") + more_bytes), old_.rlim_max};
        ::setrlimit(RLIMIT_AS, &limit);
    }
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;
    ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &old_); }

private:
    rlimit old_;
};

// Too little for the floats, or enough for these but not for what libjpeg takes.
TEST_F(Memory, TooLittleIsReportedWithTheSize) {
    const Image image = make_image(kWidth, kHeight);
    for (const std::string name : {"a.pfm", "a.hdr", "a.exr", "a.png"}) write_image(in_folder(name), image);
    write_bytes(in_folder("a.tga"), tga_header(24) + std::string(3 * std::size_t(kWidth) * kHeight, 'x'));
    write_progressive_jpg(in_folder("a.jpg"));
    (void)read_image(in_folder("a.exr")); // starts the threads, which need address space
    malloc_trim(0);
    const auto error_of_reading = [&](const std::string& name, double bytes) {
        const MemoryLimit limit(bytes);
        return error_of([&] { (void)read_image(in_folder(name)); });
    };
    for (const std::string name : {"a.pfm", "a.hdr", "a.exr", "a.png", "a.tga", "a.jpg"})
        EXPECT_EQ(error_of_reading(name, 0.9 * kFloatBytes),
                  "cannot read '" + in_folder(name).string() +
                      "': not enough memory for its 2100 x 1400 pixels (36 MB); close other programs or use "
                      "a smaller image");
    EXPECT_NE(
        error_of_reading("a.jpg", 1.2 * kFloatBytes).find("not enough memory for its 2100 x 1400 pixels"),
        std::string::npos);
}

} // namespace

} // namespace nusselt::image::test
