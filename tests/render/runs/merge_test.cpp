/// Images of several parts or seeds together: means by numbers of samples, and what is refused.

#include "render/merge.h"

#include "image/content_hash.h"
#include "image/packed_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace nusselt::render_test {
namespace {

using image::LayeredImage;
using render::Merger;

/// Two pixels with a value each. \param samples per pixel, as a layer
LayeredImage make_input(const char* seed, float a, float b, float samples_a, float samples_b) {
    LayeredImage image;
    image.data = image.display = {0, 0, 2, 1};
    image.metadata = {{"seed", seed},  {"technique", "area"},     {"samples", "8"},
                      {"isa", "avx2"}, {"render_seconds", "1.5"}, {"scene_fingerprint", "12"},
                      {"part", "1/2"}};
    image.layers = {{"", {"R", "G", "B"}, {a, a, a, b, b, b}}, {"samples", {"Y"}, {samples_a, samples_b}}};
    return image;
}

/// Inputs without a hash get that of what they are, as if they had been written so.
LayeredImage merged(std::vector<LayeredImage> images) {
    Merger merger;
    for (LayeredImage& image : images)
        if (image.metadata.count(image::kContentHashKey) + image.metadata.count(image::kPackedHashKey) == 0)
            add_content_hash(image);
    for (std::size_t i = 0; i < images.size(); ++i) merger.add(images[i], "in" + std::to_string(i) + ".exr");
    return merger.result();
}

std::string problem_with(const std::vector<LayeredImage>& images) {
    try {
        merged(images);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(Merge, WeighsBySamples) {
    const LayeredImage result =
        merged({make_input("0", 1, 5, 8, 8), make_input("1", 4, 1, 4, 8), make_input("2", 10, 3, 4, 0)});
    EXPECT_EQ(result.layers[0].data[0], (8.0 * 1 + 4 * 4 + 4 * 10) / 16);
    EXPECT_EQ(result.layers[0].data[3], 3);
    // The metadata state that all pixels have 16 samples.
    EXPECT_EQ(result.layers.size(), 1u);
    EXPECT_EQ(result.metadata.at("samples"), "16");
    EXPECT_EQ(result.metadata.at("seed"), "0 1 2");
    EXPECT_EQ(result.metadata.at("finished_fraction"), "1");
    EXPECT_EQ(std::stod(result.metadata.at("render_seconds")), 4.5);
    EXPECT_EQ(result.metadata.count("part"), 0u);
}

TEST(Merge, KeepsBitsOfPixelsThatOneImageHas) {
    const float tiny = 1.1754942e-38f;
    const LayeredImage result = merged({make_input("0", 0.1f, 0, 8, 0), make_input("0", 0, tiny, 0, 8)});
    EXPECT_EQ(result.layers[0].data[0], 0.1f);
    EXPECT_EQ(result.layers[0].data[5], tiny);
    EXPECT_EQ(result.metadata.at("seed"), "0");
}

TEST(Merge, ResultsCanBeMergedAgain) {
    const LayeredImage first = merged({make_input("0", 1, 5, 8, 8), make_input("1", 4, 1, 4, 8)});
    ASSERT_EQ(first.layers.back().name, "samples");
    EXPECT_EQ(first.layers.back().data, (std::vector<float>{12, 16}));
    const LayeredImage result = merged({first, make_input("2", 10, 3, 4, 0)});
    EXPECT_FLOAT_EQ(result.layers[0].data[0], 4);
    EXPECT_NE(problem_with({first, make_input("1", 10, 3, 4, 0)}), "");
}

TEST(Merge, OfImagesFromGpusNamesNoInstructionSet) {
    std::vector<LayeredImage> images = {make_input("1", 1, 1, 4, 4), make_input("2", 2, 2, 4, 4)};
    EXPECT_EQ(merged(images).metadata.at("isa"), "avx2");
    for (LayeredImage& image : images) image.metadata.erase("isa");
    EXPECT_FALSE(merged(images).metadata.contains("isa"));
}

TEST(Merge, OfEmptyPartsStaysAPart) {
    const LayeredImage nothing = merged({make_input("0", 0, 0, 0, 0), make_input("0", 0, 0, 0, 0)});
    EXPECT_EQ(nothing.layers.back().name, "samples");
    EXPECT_EQ(nothing.layers.back().data, (std::vector<float>{0, 0}));
    EXPECT_EQ(nothing.metadata.count("samples"), 0u);
    EXPECT_EQ(nothing.metadata.at("part"), "1/2");
    EXPECT_EQ(nothing.metadata.at("finished_fraction"), "0");
    // The seed is still free.
    const LayeredImage result = merged({nothing, make_input("0", 1, 5, 8, 8)});
    EXPECT_EQ(result.layers[0].data, (std::vector<float>{1, 1, 1, 5, 5, 5}));
    EXPECT_EQ(result.metadata.at("samples"), "8");
}

TEST(Merge, NamesTheCulpritAmongMany) {
    // The parts have one pixel each in turn; images of two seeds block both.
    const LayeredImage both = merged({make_input("0", 1, 0, 8, 0), make_input("1", 1, 0, 8, 0)});
    const LayeredImage third = make_input("2", 1, 1, 8, 8);
    const LayeredImage rest = make_input("1", 0, 1, 0, 8);
    EXPECT_EQ(problem_with({both, third, rest, make_input("0", 0, 1, 0, 8)}), "");
    EXPECT_NE(problem_with({third, both, rest, make_input("1", 0, 1, 0, 8)}).find("in2.exr"),
              std::string::npos);
    EXPECT_NE(problem_with({third, both, rest, make_input("1", 1, 0, 8, 0)}).find("in1.exr"),
              std::string::npos);
}

TEST(Merge, CombinesVariances) {
    const auto with_variance = [](const char* seed, float variance, float samples) {
        LayeredImage image = make_input(seed, 1, 1, samples, samples);
        image.layers.push_back({"variance", {"R", "G", "B"}, std::vector<float>(6, variance)});
        return image;
    };
    const LayeredImage result =
        merged({with_variance("0", 3, 4), with_variance("1", 6, 4), with_variance("2", 2, 8)});
    // The variance of (x0 + x1 + 2 x2) / 4.
    EXPECT_NEAR(result.layers[1].data[0], (3 + 6 + 4 * 2) / 16.0, 1e-6);
}

TEST(Merge, DepthIsAMeanOverHits) {
    const auto with_depth = [](const char* seed, float depth, float coverage) {
        LayeredImage image = make_input(seed, 1, 1, 8, 8);
        image.layers.push_back({"coverage", {"Y"}, {coverage, 0}});
        image.layers.push_back({"depth", {"Z"}, {depth, 0}});
        return image;
    };
    const LayeredImage result = merged({with_depth("0", 2, 0.25f), with_depth("1", 6, 0.75f)});
    EXPECT_EQ(result.layers[1].data[0], 0.5f);
    EXPECT_EQ(result.layers[2].data[0], 5);
    EXPECT_EQ(result.layers[2].data[1], 0);
}

TEST(Merge, RefusesTheSameSamplesTwice) {
    const LayeredImage image = make_input("0", 1, 5, 8, 8);
    EXPECT_NE(problem_with({image, image}).find("twice"), std::string::npos);
    // Parts overlap in the second pixel.
    EXPECT_NE(problem_with({make_input("0", 1, 5, 8, 8), make_input("0", 0, 5, 0, 8)}).find("in0.exr"),
              std::string::npos);
    EXPECT_EQ(problem_with({make_input("0", 1, 5, 8, 0), make_input("0", 0, 5, 0, 8)}), "");
}

/// Two pixels in tiles of one pixel; each part has one of them.
LayeredImage make_part(int x, float value) {
    LayeredImage image = make_input("0", 0, 0, 8, 8);
    image.metadata["part"] = x == 0 ? "1/2" : "2/2";
    image.layers.pop_back(); // the metadata have the number
    std::fill_n(image.layers[0].data.begin() + 3 * x, 3, value);
    image::PackedTiles tiles(image.data, 1);
    tiles.add(x, 0);
    return pack(std::move(image), tiles);
}

TEST(Merge, TakesPartsWithAndWithoutTheirOtherPixels) {
    const std::vector<float> expected = {3, 3, 3, 5, 5, 5};
    EXPECT_EQ(merged({make_part(0, 3), make_part(1, 5)}).layers[0].data, expected);
    EXPECT_EQ(merged({image::unpack(make_part(0, 3)), make_part(1, 5)}).layers[0].data, expected);
    EXPECT_EQ(merged({make_part(1, 5), image::unpack(make_part(0, 3))}).layers[0].data, expected);
    const LayeredImage both = merged({image::unpack(make_part(1, 5)), image::unpack(make_part(0, 3))});
    EXPECT_EQ(both.layers[0].data, expected);
    EXPECT_EQ(both.metadata.at("samples"), "8");
}

TEST(Merge, RefusesImagesThatWereChanged) {
    const LayeredImage result = merged({make_input("0", 1, 5, 8, 8), make_input("1", 4, 1, 8, 8)});
    EXPECT_EQ(problem_with({result, make_input("2", 1, 1, 8, 8)}), "");
    LayeredImage hole = result;
    hole.layers[0].data[3] = 0;
    LayeredImage more_samples = result;
    more_samples.metadata["samples"] = "17";
    LayeredImage other_seed = result;
    other_seed.metadata["seed"] = "3";
    LayeredImage moved = result;
    moved.data.x = 1;
    for (const LayeredImage& wrong : {hole, more_samples, other_seed, moved})
        EXPECT_NE(problem_with({wrong}).find("not those that were written"), std::string::npos);
    hole.metadata.erase(image::kContentHashKey);
    EXPECT_THROW(Merger().add(hole, "in.exr"), std::runtime_error) << "damage may change the key, too";
    LayeredImage fewer_pixels = make_input("0", 1, 5, 8, 8);
    fewer_pixels.layers[0].data.pop_back();
    EXPECT_NE(problem_with({fewer_pixels}).find("other pixels than its window"), std::string::npos);
}

TEST(Merge, NamesNoPartsThatCannotBe) {
    for (const char* part : {"1/2000000000", "0/2", "3/2", "1/-5", "1/1048577"}) {
        LayeredImage image = make_input("0", 1, 0, 8, 0);
        image.metadata["part"] = part;
        add_content_hash(image);
        Merger merger;
        merger.add(image, "in.exr");
        EXPECT_EQ(merger.what_is_missing(), "the parts do not divide the image in the same way") << part;
    }
}

TEST(Merge, RefusesWhatDoesNotBelongTogether) {
    const LayeredImage first = make_input("0", 1, 5, 8, 8);
    LayeredImage other = make_input("1", 1, 5, 8, 8);
    other.metadata["technique"] = "solid_angle";
    EXPECT_NE(problem_with({first, other}).find("technique"), std::string::npos);

    other = make_input("1", 1, 5, 8, 8);
    other.metadata["mis"] = "balance";
    EXPECT_NE(problem_with({first, other}).find("mis"), std::string::npos);

    other = make_input("1", 1, 5, 8, 8);
    other.data.x = 1;
    EXPECT_NE(problem_with({first, other}).find("2 x 1"), std::string::npos);

    other = make_input("1", 1, 5, 8, 8);
    other.layers.push_back({"albedo", {"R"}, {1, 1}});
    EXPECT_NE(problem_with({first, other}).find("albedo.R"), std::string::npos);
}

TEST(Merge, RefusesImagesWithoutNumbersOfSamples) {
    LayeredImage image = make_input("0", 1, 5, 8, 8);
    image.layers.pop_back();
    for (const char* number : {"0", "-3", "nan", "1e300", "many", ""}) {
        image.metadata["samples"] = number;
        EXPECT_NE(problem_with({image}).find("samples"), std::string::npos) << number;
    }
    image.metadata.erase("samples");
    EXPECT_NE(problem_with({image}), "");
    for (const float number : {-1.0f, std::nanf(""), std::numeric_limits<float>::infinity()})
        EXPECT_NE(problem_with({make_input("0", 1, 5, number, 8)}).find("samples"), std::string::npos);
}

} // namespace
} // namespace nusselt::render_test
