// Layers, parts of images on several machines, and merging.

#include "program.h"

#include "image/io.h"
#include "image/layers.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

namespace nusselt {

namespace {

/// Expects the same floats in the same layers.
void expect_same_layers(const image::LayeredImage& a, const image::LayeredImage& b) {
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (std::size_t i = 0; i < a.layers.size(); ++i) {
        EXPECT_EQ(a.layers[i].name, b.layers[i].name);
        EXPECT_EQ(a.layers[i].data, b.layers[i].data) << a.layers[i].name;
    }
}

class RenderParts : public CommandLine {
protected:
    std::string render(const std::string& rest) const {
        return "render '" + kScenes + "/room.pbrt' --resolution 80x60 --spp 2 -q " + rest;
    }
    void expect_success(const std::string& arguments) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << arguments << outcome.err;
        EXPECT_EQ(outcome.err, "") << arguments;
    }
    image::LayeredImage layers(const std::string& name) const { return image::read_layers(path(name)); }
};

TEST_F(RenderParts, MergedAreTheWholeImageBitByBit) {
    expect_success(render("--layers all -o whole.exr"));
    std::string inputs;
    for (const char* number : {"3", "1", "2"}) {
        const std::string name = std::string("part") + number + ".exr";
        expect_success(render("--layers all --part " + std::string(number) + "/3 -o " + name));
        inputs += " " + name;
    }
    // Parts hold their tiles only: 7 of 20 for the first.
    EXPECT_LT(std::filesystem::file_size(path("part1.exr")),
              0.4 * double(std::filesystem::file_size(path("whole.exr"))));
    expect_success("merge -o merged.exr" + inputs);
    const image::LayeredImage whole = layers("whole.exr");
    const image::LayeredImage merged = layers("merged.exr");
    EXPECT_GE(whole.layers.size(), 10u);
    expect_same_layers(merged, whole);
    EXPECT_EQ(merged.metadata.at("samples"), "2");
    EXPECT_EQ(merged.metadata.at("finished_fraction"), "1");

    // Two thirds of the image are an image as well.
    const Outcome some = run("merge -o some.exr part1.exr part2.exr");
    EXPECT_EQ(some.exit_code, 1);
    // Of 20 tiles, the third part has 6; the last row of tiles has 12 rows of pixels.
    expect_message(some.err, " % of the pixels have samples: part 3/3 is missing; add what is missing");
    expect_message(some.err, "--partial");
    EXPECT_FALSE(std::filesystem::exists(path("some.exr")));
    expect_success("merge --partial -o some.exr part1.exr part2.exr");
    expect_success("merge -o again.exr some.exr part3.exr");
    expect_same_layers(layers("again.exr"), whole);
}

TEST_F(RenderParts, SeedsAreMergedToTheirMean) {
    expect_success(render("-o a.exr"));
    expect_success(render("-o b.exr --seed 1"));
    expect_success("merge -o mean.exr a.exr b.exr");
    const std::vector<float> a = image::read_image(path("a.exr")).pixels;
    const std::vector<float> b = image::read_image(path("b.exr")).pixels;
    const image::LayeredImage mean = layers("mean.exr");
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_EQ(mean.layers[0].data[i], static_cast<float>((2 * double(a[i]) + 2 * double(b[i])) / 4));
    EXPECT_EQ(mean.metadata.at("samples"), "4");
    EXPECT_EQ(mean.metadata.at("seed"), "0 1");
}

TEST_F(RenderParts, MergeRefusesWhatDoesNotFit) {
    expect_success(render("-o a.exr"));
    expect_success(render("-o part.exr --part 1/2"));
    expect_success(render("-o technique.exr --seed 1 --technique area --strategies diffuse"));
    expect_success("render '" + kScenes + "/room.pbrt' --resolution 8x8 --spp 2 -q -o small.exr --seed 1");
    expect_success(render("-o layers.exr --seed 1 --layers albedo"));
    expect_success("render '" + kScenes +
                   "/cornell-panel.pbrt' --resolution 80x60 --spp 2 -q -o scene.exr --seed 1");
    for (const auto& [inputs, text] :
         {std::pair("a.exr a.exr", "twice"), std::pair("a.exr part.exr", "twice"),
          std::pair("a.exr technique.exr", "technique"), std::pair("a.exr small.exr", "8 x 8"),
          std::pair("a.exr layers.exr", "albedo"), std::pair("a.exr scene.exr", "scene"),
          std::pair("a.exr missing.exr", "missing.exr")}) {
        const Outcome wrong = run(std::string("merge -o merged.exr ") + inputs);
        EXPECT_EQ(wrong.exit_code, 1) << inputs;
        expect_message(wrong.err, text);
        EXPECT_FALSE(std::filesystem::exists(path("merged.exr"))) << inputs;
    }
    expect_message(run("merge -o no/such/folder/a.exr a.exr").err, "no/such/folder");
}

TEST_F(RenderParts, MergeNeverOverwritesAnInput) {
    expect_success(render("-o p1.exr --part 1/2"));
    expect_success(render("-o p2.exr --part 2/2"));
    const std::string before = read("p1.exr");
    for (const auto& [arguments, code, text] :
         {std::tuple("merge p1.exr p1.exr p2.exr", 2, "'p1.exr' exists"),
          std::tuple("merge -o p1.exr p1.exr p2.exr", 1, "'p1.exr' is an output and also an input")}) {
        const Outcome wrong = run(arguments);
        EXPECT_EQ(wrong.exit_code, code) << arguments;
        expect_message(wrong.err, text);
        EXPECT_EQ(read("p1.exr"), before);
    }
}

/// The form of version 0.1 works for one more version.
TEST_F(RenderParts, MergeTakesTheOutputFirstWithAWarning) {
    expect_success(render("-o p1.exr --part 1/2"));
    expect_success(render("-o p2.exr --part 2/2"));
    const Outcome old = run("merge out.exr p1.exr p2.exr");
    EXPECT_EQ(old.exit_code, 0);
    EXPECT_EQ(old.err, "warning: `merge OUT IN...` is deprecated; use `merge -o out.exr IN...`\n");
    EXPECT_EQ(layers("out.exr").metadata.at("finished_fraction"), "1");
    // Somebody who forgets -o keeps the first part.
    const std::string before = read("p1.exr");
    const Outcome forgotten = run("merge p1.exr p2.exr");
    EXPECT_EQ(forgotten.exit_code, 2);
    expect_message(forgotten.err, "'p1.exr' exists; use `merge -o OUT IN...` to replace it");
    EXPECT_EQ(read("p1.exr"), before);
}

TEST_F(RenderParts, WhatIsWrongWithPartsIsNamed) {
    for (const char* number : {"1", "2", "3", "4", "5"})
        expect_success(render(std::string("--part ") + number + "/5 -o p" + number + ".exr"));
    const auto refusal = [&](const std::string& inputs, const std::string& text) {
        std::filesystem::remove(path("merged.exr"));
        const Outcome wrong = run("merge -o merged.exr " + inputs);
        EXPECT_EQ(wrong.exit_code, 1) << inputs;
        expect_message(wrong.err, text);
        EXPECT_FALSE(std::filesystem::exists(path("merged.exr"))) << inputs;
    };
    refusal("p1.exr p3.exr p5.exr", "parts 2/5 and 4/5 are missing");
    refusal("p1.exr p2.exr p3.exr p4.exr p3.exr p5.exr",
            "'p3.exr': it has samples of the same seed at the same pixels as 'p3.exr'");
    // Merged images remember their parts, and may be merged in any order.
    expect_success("merge --partial -o some.exr p5.exr p2.exr");
    refusal("some.exr p1.exr p4.exr", "part 3/5 is missing");
    refusal("p1.exr p2.exr some.exr",
            "'some.exr': it has samples of the same seed at the same pixels as 'p2.exr'");
    expect_success("merge -o merged.exr p4.exr some.exr p1.exr p3.exr");
    expect_success(render("-o whole.exr"));
    expect_same_layers(layers("merged.exr"), layers("whole.exr"));
    // Parts of another division overlap, here or there.
    expect_success(render("--part 2/3 -o q2.exr"));
    refusal("p1.exr p2.exr p3.exr p4.exr q2.exr", "'q2.exr': it has samples of the same seed");
    // A part of the file is missing, or is not what was written.
    const std::string part = read("p2.exr");
    const auto write = [&](const std::string& bytes) {
        std::ofstream(path("p2.exr"), std::ios::binary) << bytes;
    };
    const std::string rest = "p1.exr p2.exr p3.exr p4.exr p5.exr";
    for (const std::size_t size : {part.size() - 1, part.size() / 2, std::size_t(0)}) {
        write(part.substr(0, size));
        refusal(rest, "p2.exr");
    }
    std::string damaged = part;
    damaged[part.size() - 100] ^= 1;
    write(damaged);
    refusal(rest, "'p2.exr': its pixels are not those that were written");
    std::fill(damaged.end() - 1000, damaged.end(), '\0');
    write(damaged);
    refusal(rest, "p2.exr");
    write(part);
    expect_success("merge -o merged.exr " + rest);
}

TEST_F(RenderParts, OtherCommandsSeePartsInTheirPlace) {
    expect_success(render("-o whole.exr"));
    expect_success(render("--part 1/2 -o part.exr"));
    const image::Image part = image::read_image(path("part.exr"));
    const image::Image whole = image::read_image(path("whole.exr"));
    ASSERT_EQ(part.pixels.size(), whole.pixels.size());
    std::size_t same = 0;
    for (std::size_t i = 0; i < part.pixels.size(); ++i) {
        EXPECT_TRUE(part.pixels[i] == whole.pixels[i] || part.pixels[i] == 0) << i;
        same += part.pixels[i] == whole.pixels[i] ? 1 : 0;
    }
    EXPECT_GE(same, part.pixels.size() / 3);
    expect_success("convert part.exr part.png");
    EXPECT_EQ(image::read_image(path("part.png")).width, 80);
}

/// More parts than the image has tiles.
TEST_F(RenderParts, MayBeEmpty) {
    const std::string command = "render '" + kScenes + "/room.pbrt' --resolution 20x16 --spp 2 -q ";
    expect_success(command + "-o whole.exr");
    for (const char* number : {"1", "2", "3"})
        expect_success(command + "--part " + number + "/3 -o p" + number + ".exr");
    expect_success("merge -o merged.exr p3.exr p1.exr p2.exr");
    expect_same_layers(layers("merged.exr"), layers("whole.exr"));
}

TEST_F(RenderParts, ConvertedImagesAreNotMerged) {
    expect_success(render("-o one.exr --seed 1"));
    expect_success(render("-o two.exr --seed 2"));
    expect_success("convert one.exr bright.exr --exposure 3");
    const Outcome outcome = run("merge -o merged.exr bright.exr two.exr");
    EXPECT_EQ(outcome.exit_code, 1);
    expect_message(outcome.err, "bright.exr");
    expect_message(outcome.err, "it was converted by `nusselt convert`");
}

TEST_F(RenderParts, OutputsDoNotOverwriteEachOtherOrWhatIsRead) {
    for (const char* names :
         {"-o a.exr --json a.exr", "-o a.exr -o ./a.exr", "-o a.exr --checkpoint a.exr"}) {
        const Outcome outcome = run(render(names));
        EXPECT_EQ(outcome.exit_code, 1) << names;
        expect_message(outcome.err, "another output");
    }
    const Outcome outcome =
        run("render '" + kScenes + "/room.pbrt' -o a.exr --json '" + kScenes + "/room.pbrt'");
    EXPECT_EQ(outcome.exit_code, 1);
    expect_message(outcome.err, "an input");
}

TEST_F(RenderParts, MayComeFromScenesInOtherFolders) {
    std::filesystem::create_directory(path("copy"));
    std::filesystem::copy(kScenes, path("copy"), std::filesystem::copy_options::recursive);
    expect_success(render("--layers lights --part 1/2 -o part1.exr"));
    expect_success(
        "render copy/room.pbrt --resolution 80x60 --spp 2 -q --layers lights --part 2/2 -o part2.exr");
    expect_success("merge -o merged.exr part1.exr part2.exr");
    EXPECT_EQ(layers("merged.exr").metadata.at("samples"), "2");
}

TEST_F(RenderParts, NameFilesOfTheirOwn) {
    expect_success(render("--part 2/3"));
    EXPECT_TRUE(std::filesystem::exists(path("room-2of3.exr")));
}

TEST_F(RenderParts, WrongValuesAreWrongUsage) {
    for (const char* arguments : {"render a.pbrt --part 0/2",
                                  "render a.pbrt --part 3/2",
                                  "render a.pbrt --part 1",
                                  "render a.pbrt --part 1/",
                                  "render a.pbrt --part -1/2",
                                  "render a.pbrt --part 1/2x",
                                  "render a.pbrt --part 1/99999999999",
                                  "render a.pbrt --layers velvet",
                                  "render a.pbrt --layers",
                                  "render a.pbrt --layers all -o a.png",
                                  "render a.pbrt --part 1/2 -o a.hdr",
                                  "render a.pbrt --exposure nan",
                                  "render a.pbrt --exposure inf",
                                  "render a.pbrt --exposure 65",
                                  "render a.pbrt --visibility-estimate nan",
                                  "render a.pbrt --visibility-estimate -0.1",
                                  "render a.pbrt --checkpoint-interval 0",
                                  "render a.pbrt --checkpoint-interval nan",
                                  "render a.pbrt --checkpoint-interval 1e7",
                                  "render a.pbrt --checkpoint-interval 5",
                                  "merge",
                                  "merge a.exr",
                                  "merge -o a.png b.exr",
                                  "merge -o a.exr b.png"}) {
        const Outcome wrong = run(arguments);
        EXPECT_EQ(wrong.exit_code, 2) << arguments;
        expect_message(wrong.err, "--help");
    }
}

TEST_F(RenderParts, SaysThatOneCameraRayHasNoVariance) {
    const Outcome outcome =
        run("render '" + kScenes + "/room.pbrt' --resolution 16x9 --layers variance,albedo -o a.exr");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("warning: the layer of the variance is missing"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(image::find_layer(layers("a.exr"), "variance"), nullptr);
    EXPECT_NE(image::find_layer(layers("a.exr"), "albedo"), nullptr);
}

TEST_F(RenderParts, ImagesThatNoFileCanHoldAreRefusedFirst) {
    const Outcome outcome =
        run("render '" + kScenes + "/room.pbrt' --resolution 65536x65536 --spp 2 -q --layers all -o a.exr");
    EXPECT_EQ(outcome.exit_code, 1);
    expect_message(outcome.err, "65536 x 65536");
}

} // namespace

} // namespace nusselt
