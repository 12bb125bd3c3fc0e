/// Files that hold some tiles of an image: these tiles and no more, readable by all programs, whole again for ours.

#include "image/content_hash.h"
#include "image/io.h"
#include "image/packed_tiles.h"
#include "image_fixture.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <algorithm>
#include <vector>

namespace nusselt::image::test {

namespace {

using PackedTilesTest = ImageTest;

/// Every pixel has values of its own.
LayeredImage make_whole(const Window& window) {
    LayeredImage image{window, {0, 0, 200, 100}, {}, {{"samples", "4"}}, {}};
    const std::size_t pixels = std::size_t(window.width) * std::size_t(window.height);
    image.layers = {{"", {"R", "G", "B"}, std::vector<float>(3 * pixels)},
                    {"depth", {"Z"}, std::vector<float>(pixels)}};
    for (Layer& layer : image.layers)
        for (std::size_t i = 0; i < layer.data.size(); ++i) layer.data[i] = float(i + 1);
    return image;
}

/// Whether a pixel of the film is in a tile of the example: every third one, counted along rows.
bool is_chosen(const Window& window, int x, int y) {
    const int columns = (window.x + window.width - 1) / 16 - window.x / 16 + 1;
    return ((y / 16 - window.y / 16) * columns + x / 16 - window.x / 16) % 3 == 1;
}

PackedTiles every_third(const Window& window) {
    PackedTiles tiles(window, 16);
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            if (is_chosen(window, x, y)) tiles.add(x, y);
    return tiles;
}

/// A crop whose edges are no edges of tiles, a whole number of tiles, and less than a tile.
const std::vector<Window> kWindows = {{5, 21, 150, 70}, {16, 32, 64, 48}, {0, 0, 7, 3}};

TEST_F(PackedTilesTest, ReadersPutTilesBackToTheirPlaces) {
    for (const Window& window : kWindows) {
        const PackedTiles tiles = every_third(window);
        write_layers(in_folder("part.exr"), pack(make_whole(window), tiles));
        LayeredImage expected = make_whole(window);
        for (Layer& layer : expected.layers)
            for (std::size_t i = 0; i < layer.data.size(); ++i) {
                const auto pixel = int(i / layer.channels.size());
                if (!is_chosen(window, window.x + pixel % window.width, window.y + pixel / window.width))
                    layer.data[i] = 0;
            }
        const LayeredImage read = read_layers(in_folder("part.exr"));
        EXPECT_EQ(read.data, window);
        EXPECT_EQ(read.display, expected.display);
        expected.metadata[kPackedHashKey] = read.metadata.at(kPackedHashKey);
        EXPECT_EQ(read.metadata, expected.metadata);
        // The layer of samples tells pixels that are not there from black ones.
        ASSERT_EQ(read.layers.size(), 3u);
        for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(read.layers[i].data, expected.layers[i].data);
        std::vector<float> samples;
        for (const float depth : expected.layers[1].data) samples.push_back(depth == 0 ? 0.0f : 4.0f);
        EXPECT_EQ(read.layers[2].name, kSamplesLayer);
        EXPECT_EQ(read.layers[2].data, samples);
        EXPECT_EQ(read_layer(in_folder("part.exr"), kSamplesLayer).layers.at(0).data, samples);
        EXPECT_EQ(read_layer_list(in_folder("part.exr")).layers.at(2).name, kSamplesLayer);
        const Image picture = read_image(in_folder("part.exr"));
        EXPECT_EQ(picture.width, window.width);
        EXPECT_EQ(picture.pixels, expected.layers[0].data);
        EXPECT_EQ(read_layer(in_folder("part.exr"), "depth").layers.at(0).data, expected.layers[1].data);
        EXPECT_EQ(read_layer_list(in_folder("part.exr")).data, window);
    }
}

TEST_F(PackedTilesTest, FilesHoldTheTilesAndNoMore) {
    const Window window = {0, 0, 640, 480};
    PackedTiles quarter(window, 16);
    for (int tile = 0; tile < 40 * 30; tile += 4) quarter.add(tile % 40 * 16, tile / 40 * 16);
    write_layers(in_folder("whole.exr"), make_whole(window));
    write_layers(in_folder("part.exr"), pack(make_whole(window), quarter));
    const auto size = [&](const char* name) { return double(std::filesystem::file_size(in_folder(name))); };
    EXPECT_LT(size("part.exr"), 0.27 * size("whole.exr"));
}

TEST_F(PackedTilesTest, OtherProgramsSeeAMosaicOfTheTiles) {
    const Window window = {16, 32, 64, 48};
    write_layers(in_folder("part.exr"), pack(make_whole(window), every_third(window)));
    Imf::InputFile file(in_folder("part.exr").c_str());
    EXPECT_TRUE(file.isComplete());
    // Four tiles in a square.
    EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({0, 0}, {31, 31}));
    const LayeredImage read = read_packed_layers(in_folder("part.exr"));
    std::vector<float> tile_pixels;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            if (is_chosen(window, 16 + x, 32 + y)) tile_pixels.push_back(float(y * 64 + x + 1));
    std::vector<float> stored = read.layers[1].data;
    std::sort(stored.begin(), stored.end());
    EXPECT_EQ(stored, tile_pixels);
}

TEST_F(PackedTilesTest, AFileWithoutTilesIsBlack) {
    const Window window = {0, 0, 7, 3};
    write_layers(in_folder("part.exr"), pack(make_whole(window), PackedTiles(window, 16)));
    const Image picture = read_image(in_folder("part.exr"));
    EXPECT_EQ(picture.pixels, std::vector<float>(3 * 7 * 3));
}

TEST_F(PackedTilesTest, EachPixelThatIsThereIsInOneRun) {
    for (const Window& window : kWindows) {
        const PackedTiles tiles = every_third(window);
        std::vector<int> counts(std::size_t(window.width) * std::size_t(window.height));
        std::set<std::size_t> packed;
        for (const PixelRun& run : tiles.runs())
            for (std::size_t i = 0; i < run.count; ++i) {
                ++counts.at(run.whole + i);
                EXPECT_TRUE(packed.insert(run.packed + i).second);
            }
        for (std::size_t i = 0; i < counts.size(); ++i)
            ASSERT_EQ(counts[i],
                      is_chosen(window, window.x + int(i) % window.width, window.y + int(i) / window.width));
        EXPECT_EQ(PackedTiles(tiles.text()).text(), tiles.text());
    }
}

TEST_F(PackedTilesTest, DamagedListsAreErrorsThatNameTheFile) {
    const Window window = {16, 32, 64, 48};
    const LayeredImage part = pack(make_whole(window), every_third(window));
    EXPECT_EQ(part.metadata.at(kTilesKey), "16 32 64 48 16 492");
    for (const char* text :
         {"", "16", "16 32 64 48 16", "16 32 64 48 16 49", "16 32 64 48 16 4920", "16 32 64 48 16 49g",
          "16 32 64 48 0 492", "16 32 64 48 9999 8", "-1 32 64 48 16 492", "16 32 0 48 16 492",
          "16 32 99999 99999 16 492", "16 32 64 48 16 492 1", "16 32 64 48 16 fff", "17 32 50 48 16 ffff",
          "1 1 16 16 16 ff", "99999999999 32 64 48 16 492"}) {
        LayeredImage wrong = part;
        wrong.metadata[kTilesKey] = text;
        write_layers(in_folder("part.exr"), wrong);
        for (const std::string& problem : {error_of([&] { (void)read_layers(in_folder("part.exr")); }),
                                           error_of([&] { (void)read_image(in_folder("part.exr")); }),
                                           error_of([&] { (void)packed_tiles_of(wrong); })})
            EXPECT_NE(problem, "") << text;
        EXPECT_NE(error_of([&] { (void)read_image(in_folder("part.exr")); }).find("part.exr"),
                  std::string::npos);
    }
}

TEST_F(PackedTilesTest, PackedAgainAreTheSameFileOrOneThatIsKnownAsChanged) {
    const Window window = {5, 21, 150, 70};
    const PackedTiles tiles = every_third(window);
    LayeredImage with_samples = make_whole(window);
    with_samples.layers.push_back({kSamplesLayer, {"Y"}, std::vector<float>(150 * 70, 2)});
    for (const LayeredImage& whole : {make_whole(window), with_samples}) {
        const LayeredImage part = pack(LayeredImage(whole), tiles);
        const LayeredImage again = pack(unpack(LayeredImage(part)), tiles);
        EXPECT_EQ(again.metadata, part.metadata);
        ASSERT_EQ(again.layers.size(), part.layers.size());
        for (std::size_t i = 0; i < part.layers.size(); ++i)
            EXPECT_EQ(again.layers[i].data, part.layers[i].data);
        check_content_hash(again);
        LayeredImage changed = unpack(LayeredImage(part));
        for (float& value : changed.layers[0].data) value *= 2;
        EXPECT_NE(error_of([&] { check_content_hash(pack(std::move(changed), tiles)); }), "");
    }
}

/// Bits of the list that are exchanged leave as many tiles: only the hash finds them.
TEST_F(PackedTilesTest, AHashProtectsPixelsAndTheirPlaces) {
    const Window window = {16, 32, 64, 48};
    const LayeredImage part = pack(make_whole(window), every_third(window));
    LayeredImage moved = part;
    moved.metadata[kTilesKey] = "16 32 64 48 16 294";
    LayeredImage other_seed = part;
    other_seed.metadata["seed"] = "7";
    LayeredImage other_samples = part;
    other_samples.metadata["samples"] = "8";
    LayeredImage hole = part;
    std::fill_n(hole.layers[1].data.begin() + 7, 20, 0.0f);
    LayeredImage renamed = part;
    renamed.layers[1].name = "height";
    for (const LayeredImage& wrong : {moved, other_seed, other_samples, hole, renamed}) {
        write_layers(in_folder("part.exr"), wrong);
        EXPECT_NE(
            error_of([&] { (void)read_layers(in_folder("part.exr")); }).find("not those that were written"),
            std::string::npos);
    }
    // Damage may change the key, too.
    LayeredImage keyless = hole;
    keyless.metadata.erase(kContentHashKey);
    write_layers(in_folder("part.exr"), keyless);
    EXPECT_NE(error_of([&] { (void)read_layers(in_folder("part.exr")); }).find("hash is missing"),
              std::string::npos);
    // What hashes do not cover may change: times, for example.
    LayeredImage later = part;
    later.metadata["render_seconds"] = "5";
    write_layers(in_folder("part.exr"), later);
    EXPECT_EQ(error_of([&] { (void)read_layers(in_folder("part.exr")); }), "");
}

TEST_F(PackedTilesTest, PartsOfOneChannelAreWholeImagesForReaders) {
    const Window window = {16, 32, 64, 48};
    LayeredImage grey = make_whole(window);
    grey.layers = {{"", {"Y"}, std::move(grey.layers[1].data)}};
    write_layers(in_folder("part.exr"), pack(std::move(grey), every_third(window)));
    const Image picture = read_image(in_folder("part.exr"));
    EXPECT_EQ(picture.width, window.width);
    EXPECT_EQ(picture.pixels[3 * 16], float(17)) << "the second tile is the first that is there";
    EXPECT_EQ(picture.pixels[0], 0);
}

/// A small file must not take much memory. Who merges parts reads it as it is.
TEST_F(PackedTilesTest, SmallFilesCannotClaimHugeImages) {
    const Window window = {0, 0, 16000, 16000};
    PackedTiles one_tile(window, 16);
    one_tile.add(0, 0);
    LayeredImage part{one_tile.window(), {0, 0, 16000, 16000}, {}, {{kTilesKey, one_tile.text()}}, {}};
    part.layers = {{"", {"R", "G", "B"}, std::vector<float>(3 * 16 * 16)}};
    add_content_hash(part);
    write_layers(in_folder("part.exr"), part);
    EXPECT_NE(error_of([&] { (void)read_image(in_folder("part.exr")); }).find("1/16384"), std::string::npos);
    EXPECT_EQ(read_packed_layers(in_folder("part.exr")).layers.at(0).data.size(), 3u * 16 * 16);
}

TEST_F(PackedTilesTest, TruncatedFilesAreErrors) {
    write_layers(in_folder("part.exr"), pack(make_whole({5, 21, 150, 70}), every_third({5, 21, 150, 70})));
    const std::string bytes = read_bytes(in_folder("part.exr"));
    for (const std::size_t size : {bytes.size() - 1, bytes.size() / 2, bytes.size() / 10, std::size_t(0)}) {
        write_bytes(in_folder("part.exr"), bytes.substr(0, size));
        EXPECT_NE(error_of([&] { (void)read_packed_layers(in_folder("part.exr")); }).find("part.exr"),
                  std::string::npos);
    }
}

} // namespace

} // namespace nusselt::image::test
