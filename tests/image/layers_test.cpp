#include "image/io.h"
#include "image/layers.h"
#include "image_fixture.h"

#include "common/process_memory.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace nusselt::image::test {

namespace {

using Layers = ImageTest;

Layer random_layer(const std::string& name, const ChannelNames& channels, std::size_t pixels, unsigned seed) {
    std::vector<float> data = random_image(int(pixels), int(channels.size()), seed).pixels;
    data.resize(pixels * channels.size());
    return {name, channels, std::move(data)};
}

/// 600 rows: more than are read at a time.
LayeredImage example() {
    LayeredImage image{{0, 0, 5, 600}, {0, 0, 5, 600}, {}, {{"spp", "16"}, {"a key", "text"}}, {}};
    image.layers = {random_layer("", {"R", "G", "B"}, 3000, 1),
                    random_layer("albedo", {"R", "G", "B"}, 3000, 2), random_layer("depth", {"Z"}, 3000, 3),
                    random_layer("light.window", {"R", "G", "B"}, 3000, 4),
                    random_layer("normal", {"X", "Y", "Z"}, 3000, 5)};
    image.layers[0].data[4] = std::numeric_limits<float>::infinity();
    image.layers[2].data[8] = -0.0f;
    return image;
}

void expect_same_bits(const Layer& a, const Layer& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.channels, b.channels);
    ASSERT_EQ(a.data.size(), b.data.size());
    for (std::size_t i = 0; i < a.data.size(); ++i)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(a.data[i]), std::bit_cast<std::uint32_t>(b.data[i])) << i;
}

TEST_F(Layers, RoundTripIsBitExact) {
    LayeredImage image = example();
    image.layers[1].data[7] = std::numeric_limits<float>::quiet_NaN();
    image.foreign_metadata["owner"] = "somebody";
    write_layers(in_folder("a.exr"), image);
    const LayeredImage read = read_layers(in_folder("a.exr"));
    EXPECT_EQ(read.data, image.data);
    EXPECT_EQ(read.display, image.display);
    EXPECT_EQ(read.metadata, image.metadata);
    EXPECT_EQ(read.foreign_metadata, image.foreign_metadata);
    ASSERT_EQ(read.layers.size(), image.layers.size());
    for (std::size_t i = 0; i < read.layers.size(); ++i) expect_same_bits(read.layers[i], image.layers[i]);
    EXPECT_EQ(file_names(), std::set<std::string>{"a.exr"});
}

TEST_F(Layers, OtherReadersFindTheNamesAndThePicture) {
    const LayeredImage image = example();
    write_layers(in_folder("a.exr"), image);
    EXPECT_EQ(read_image(in_folder("a.exr")).pixels, image.layers[0].data);
    EXPECT_EQ(read_exr_metadata(in_folder("a.exr")), image.metadata);

    Imf::InputFile file(in_folder("a.exr").c_str());
    std::set<std::string> names;
    const Imf::ChannelList& channels = file.header().channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        names.insert(channel.name());
        EXPECT_EQ(channel.channel().type, Imf::FLOAT);
    }
    EXPECT_EQ(names, (std::set<std::string>{"R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "depth.Z",
                                            "light.window.R", "light.window.G", "light.window.B", "normal.X",
                                            "normal.Y", "normal.Z"}));
    std::vector<float> y(3000);
    Imf::FrameBuffer frame_buffer;
    frame_buffer.insert("normal.Y", Imf::Slice::Make(Imf::FLOAT, y.data(), file.header().dataWindow()));
    file.setFrameBuffer(frame_buffer);
    file.readPixels(0, 599);
    for (std::size_t i = 0; i < y.size(); ++i) ASSERT_EQ(y[i], image.layers[4].data[3 * i + 1]);
}

TEST_F(Layers, ACropKeepsItsPlaceOnTheFilm) {
    LayeredImage image = example();
    image.data = {17, -3, 5, 600};
    image.display = {0, 0, 640, 480};
    write_layers(in_folder("a.exr"), image);
    const LayeredImage read = read_layers(in_folder("a.exr"));
    EXPECT_EQ(read.data, image.data);
    EXPECT_EQ(read.display, image.display);
    for (std::size_t i = 0; i < read.layers.size(); ++i) expect_same_bits(read.layers[i], image.layers[i]);
    EXPECT_EQ(read_image(in_folder("a.exr")).pixels, image.layers[0].data);
}

TEST_F(Layers, HalfFloatsAndIntegersOfOtherProgramsAreRead) {
    Imf::Header header(4, 2);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.insert("comments", Imf::StringAttribute("by hand"));
    std::vector<std::uint16_t> halves = {0x3C00, 0x4000, 0xBC00, 0, 0x3800, 0x3C00, 0x7C00, 0x3C00};
    std::vector<unsigned> integers = {0, 1, 2, 3, 4, 5, 6, 70000};
    header.channels().insert("left.A", Imf::Channel(Imf::HALF));
    header.channels().insert("left.R", Imf::Channel(Imf::HALF));
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    header.channels().insert("sparse", Imf::Channel(Imf::HALF, 2, 2));
    Imf::FrameBuffer frame_buffer;
    const auto window = header.dataWindow();
    frame_buffer.insert("left.A", Imf::Slice::Make(Imf::HALF, halves.data(), window));
    frame_buffer.insert("left.R", Imf::Slice::Make(Imf::HALF, halves.data(), window));
    frame_buffer.insert("id", Imf::Slice::Make(Imf::UINT, integers.data(), window));
    frame_buffer.insert("sparse", Imf::Slice::Make(Imf::HALF, halves.data(), window, 2, 4, 2, 2));
    {
        Imf::OutputFile file(in_folder("a.exr").c_str(), header);
        file.setFrameBuffer(frame_buffer);
        file.writePixels(2);
    }
    const LayeredImage read = read_layers(in_folder("a.exr"));
    EXPECT_EQ(read.foreign_metadata, (Metadata{{"comments", "by hand"}}));
    ASSERT_EQ(read.layers.size(), 2u) << "without the channel of half resolution";
    EXPECT_EQ(read.layers[0].channels, std::vector<std::string>{"id"});
    EXPECT_EQ(read.layers[0].data, (std::vector<float>{0, 1, 2, 3, 4, 5, 6, 70000}));
    EXPECT_EQ(read.layers[1].channels, (std::vector<std::string>{"R", "A"})) << "alpha comes last";
    const float inf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(read.layers[1].data,
              (std::vector<float>{1, 1, 2, 2, -1, -1, 0, 0, 0.5f, 0.5f, 1, 1, inf, inf, 1, 1}));
}

TEST_F(Layers, AreFoundByNameAndBecomePictures) {
    const LayeredImage image = example();
    ASSERT_NE(find_layer(image, "depth"), nullptr);
    EXPECT_EQ(find_layer(image, "Depth"), nullptr);
    EXPECT_EQ(find_layer(image, ""), &image.layers[0]);
    EXPECT_EQ(layer_image(image.data, image.layers[4]).pixels, image.layers[4].data);
    const Image depth = layer_image(image.data, *find_layer(image, "depth"));
    EXPECT_EQ(depth.width, 5);
    EXPECT_EQ(depth.height, 600);
    for (std::size_t i = 0; i < depth.pixels.size(); ++i)
        ASSERT_EQ(depth.pixels[i], image.layers[2].data[i / 3]);
    const LayeredImage other{{0, 0, 1, 1},
                             {0, 0, 1, 1},
                             {{"a", {"R", "G", "B", "A"}, {1, 2, 3, 4}},
                              {"uv", {"u", "v"}, {1, 2}},
                              {"q", {"w", "x", "y", "z"}, {1, 2, 3, 4}}},
                             {},
                             {}};
    EXPECT_EQ(layer_image(other.data, other.layers[0]).pixels, (std::vector<float>{1, 2, 3}));
    EXPECT_NE(error_of([&] { (void)layer_image(other.data, other.layers[1]); }).find("'uv' has 2"),
              std::string::npos);
    EXPECT_NE(error_of([&] { (void)layer_image(other.data, other.layers[2]); }).find("'q' has 4"),
              std::string::npos);
    EXPECT_EQ(color_layer(depth).data, depth.pixels);
}

TEST_F(Layers, WhatDoesNotFitIsNotWritten) {
    const auto refused = [&](const auto& change) {
        LayeredImage image = example();
        change(image);
        EXPECT_ANY_THROW(write_layers(in_folder("a.exr"), image));
        EXPECT_TRUE(file_names().empty());
    };
    refused([](LayeredImage& image) { image.layers.clear(); });
    refused([](LayeredImage& image) { image.layers[1].data.pop_back(); });
    refused([](LayeredImage& image) { image.layers[2].channels = {}; });
    refused([](LayeredImage& image) { image.layers[2].channels = {"a.b"}; });
    refused([](LayeredImage& image) { image.layers[2].channels = {""}; });
    refused([](LayeredImage& image) { image.layers[3].name = "albedo"; });
    refused([](LayeredImage& image) { image.layers[3].name = std::string(300, 'x'); });
    refused([](LayeredImage& image) { image.data.width = 0; });
    refused([](LayeredImage& image) { image.display.height = -1; });
    refused([](LayeredImage& image) { image.data.x = std::numeric_limits<int>::max() - 2; });
    refused([](LayeredImage& image) { image.metadata[""] = "x"; });
}

TEST_F(Layers, FilesCutOffAtAnyLengthAreRefused) {
    LayeredImage image{{0, 0, 3, 2}, {0, 0, 3, 2}, {}, {{"spp", "1"}}, {}};
    image.layers = {random_layer("", {"R", "G", "B"}, 6, 1), random_layer("depth", {"Z"}, 6, 2)};
    write_layers(in_folder("a.exr"), image);
    const std::string complete = read_bytes(in_folder("a.exr"));
    for (std::size_t length = 0; length < complete.size(); ++length) {
        write_bytes(in_folder("b.exr"), complete.substr(0, length));
        const std::string error = error_of([&] { (void)read_layers(in_folder("b.exr")); });
        ASSERT_NE(error.find(in_folder("b.exr").string()), std::string::npos) << length << error;
    }
}

/// Writes layers with OpenEXR alone.
void write_with_openexr(const std::filesystem::path& path, const LayeredImage& image) {
    const auto box = [](const Window& window) {
        return Imath::Box2i({window.x, window.y},
                            {window.x + window.width - 1, window.y + window.height - 1});
    };
    Imf::Header header(box(image.display), box(image.data));
    header.compression() = Imf::NO_COMPRESSION;
    for (const auto& [key, value] : image.metadata)
        header.insert("nusselt:" + key, Imf::StringAttribute(value));
    Imf::FrameBuffer frame_buffer;
    for (const Layer& layer : image.layers) {
        const std::size_t stride = layer.channels.size() * sizeof(float);
        for (std::size_t c = 0; c < layer.channels.size(); ++c) {
            const std::string name = (layer.name.empty() ? "" : layer.name + ".") + layer.channels[c];
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame_buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, layer.data.data() + c, header.dataWindow(),
                                                       stride, stride * std::size_t(image.data.width)));
        }
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame_buffer);
    file.writePixels(image.data.height);
}

TEST_F(Layers, FilesAreThoseOfOpenExr) {
    LayeredImage image = example();
    image.data = {-3, 7, 5, 600};
    // Dots sort before letters and behind hyphens; the last name is a long one.
    for (const char* name :
         {"light", "light.window-2", "light.window.left", "light_of_a_name_beyond_31_bytes"})
        image.layers.push_back(random_layer(name, {"R", "G", "B"}, 3000, 6));
    for (const std::size_t layers : {image.layers.size(), image.layers.size() - 1}) {
        image.layers.resize(layers);
        write_layers(in_folder("ours.exr"), image);
        write_with_openexr(in_folder("openexr.exr"), image);
        EXPECT_TRUE(read_bytes(in_folder("ours.exr")) == read_bytes(in_folder("openexr.exr"))) << layers;
    }
}

TEST_F(Layers, WritingManyTakesLittleMemory) {
    if (nusselt_test::kHasSanitizer) GTEST_SKIP() << "the sanitizer takes memory of its own";
    constexpr int kLayers = 20000;
    const auto write = [&] {
        LayeredImage image{{0, 0, 16, 12}, {0, 0, 16, 12}, {}, {}, {}};
        for (int i = 0; i < kLayers; ++i)
            image.layers.push_back(
                {"light.lamp_" + std::to_string(i), {"R", "G", "B"}, std::vector<float>(3 * 16 * 12)});
        const double before = nusselt_test::process_memory("VmRSS");
        write_layers(in_folder("many.exr"), image);
        const double bytes = nusselt_test::process_memory("VmHWM") - before;
        std::fprintf(stderr, "%g bytes per layer\n", bytes / kLayers);
        std::exit(bytes <= 300.0 * kLayers ? 0 : 1);
    };
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(write(), testing::ExitedWithCode(0), "");
}

TEST_F(Layers, MoreThanAFileHoldsAreAnError) {
    EXPECT_EQ(why_not_one_exr(640, 771, 20000), std::nullopt);
    EXPECT_TRUE(why_not_one_exr(65536, 8192, 20000).has_value());
    EXPECT_TRUE(why_not_one_exr(1, 1 << 20, std::size_t(1) << 31).has_value());
}

} // namespace

} // namespace nusselt::image::test
