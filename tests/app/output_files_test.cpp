// What commands write: nothing is lost, and nothing is overwritten that was to be read.

#include "image/io.h"
#include "noise_image.h"
#include "program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace nusselt {

namespace {

class OutputFiles : public CommandLine {};

TEST_F(OutputFiles, ALimitOnTheSizeOfFilesIsAnErrorAndLeavesNothing) {
    image::write_image(path("a.exr"), noise(200, 200)); // 480 kB
    for (const char* name : {"b.exr", "b.pfm", "b.png", "b.hdr"}) {
        const Outcome limited = run(std::string("convert a.exr ") + name, "ulimit -f 20;"); // 10 or 20 kB
        EXPECT_EQ(limited.exit_code, 1) << name;
        expect_message(limited.err, "exceeds the limit on the size of files");
        for (const auto& entry : std::filesystem::directory_iterator(path(""))) {
            const std::string file = entry.path().filename();
            EXPECT_TRUE(file == "a.exr" || file == "out.txt" || file == "err.txt") << file;
        }
    }
    EXPECT_EQ(run("convert a.exr b.exr").exit_code, 0);
    EXPECT_EQ(image::read_image(path("b.exr")).pixels, noise(200, 200).pixels);
}

TEST_F(OutputFiles, NoOutputReplacesAnInputOrAnotherOutput) {
    image::write_image(path("a.exr"), noise(8, 8));
    std::ofstream(path("scene.pbrt")) << "Camera \"perspective\"\n";
    const std::string picture = read("a.exr");
    for (const char* arguments : {"convert a.exr a.exr", "convert ./a.exr a.exr",
                                  "compare a.exr a.exr --diff a.exr", "compare a.exr a.exr --json a.exr"})
        expect_message(run(arguments).err, "is an output and also an input");
    EXPECT_EQ(read("a.exr"), picture);
    expect_message(run("compare a.exr a.exr --diff d.png --abs-diff d.png").err, "another output");
    for (const char* bench : {"rays", "strategies", "emission-frames", "lines", "line-efficiency", "gpu"})
        expect_lab_message(run_lab(std::string("bench ") + bench + " scene.pbrt --json scene.pbrt").err,
                           "is an output and also an input");
    EXPECT_EQ(read("scene.pbrt"), "Camera \"perspective\"\n");
    expect_lab_message(run_lab("fit-ltc -o f --size 2x2x2 --json f.bin").err, "another output");
    expect_lab_message(run_lab("map PolygonArea scene.pbrt").err, "must be the name of an SVG file");
}

/// Files that only the scene names are known once it is loaded.
TEST_F(OutputFiles, NoOutputReplacesAFileOfTheScene) {
    image::write_image(path("room.exr"), noise(8, 8));
    std::ofstream(path("part.inc")) << "Material \"diffuse\" \"texture reflectance\" \"wood\"\n";
    std::ofstream(path("mesh.ply"))
        << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n"
           "0 0 2\n1 0 2\n0 1 2\n3 0 1 2\n";
    std::ofstream(path("room.pbrt"))
        << "Film \"rgb\" \"string filename\" \"room.exr\"\nCamera \"perspective\"\nWorldBegin\n"
           "Texture \"wood\" \"spectrum\" \"imagemap\" \"string filename\" \"room.exr\"\n"
           "Include \"part.inc\"\nShape \"plymesh\" \"string filename\" \"mesh.ply\"\n";
    std::filesystem::create_symlink("room.exr", path("link.exr"));
    const std::vector<std::string> files = {"room.exr", "part.inc", "mesh.ply", "room.pbrt"};
    std::vector<std::string> before;
    for (const std::string& file : files) before.push_back(read(file));
    for (const char* arguments : {"", "-o link.exr", "-o a.exr --json mesh.ply", "-o a.exr --json part.inc",
                                  "-o a.exr --checkpoint mesh.ply"}) {
        const Outcome outcome = run("render room.pbrt --resolution 4x4 -q " + std::string(arguments));
        EXPECT_EQ(outcome.exit_code, 1) << arguments;
        expect_message(outcome.err, "is an output and also an input");
    }
    for (const char* bench : {"rays", "strategies", "emission-frames", "lines", "line-efficiency", "gpu"})
        expect_lab_message(run_lab(std::string("bench ") + bench + " room.pbrt --json mesh.ply").err,
                           "is an output and also an input");
    for (std::size_t i = 0; i < files.size(); ++i) EXPECT_EQ(read(files[i]), before[i]) << files[i];
}

TEST_F(OutputFiles, FilmsWithoutANameGetThatOfTheScene) {
    std::ofstream(path("scene.pbrt")) << "Film \"rgb\" \"string filename\" \"/\"\n";
    EXPECT_EQ(run("render scene.pbrt --resolution 2x2").out, "scene.exr\n");
}

TEST_F(OutputFiles, ReproduceChecksItsFolderBeforeItRenders) {
    const Outcome outcome = run_lab("reproduce --scenes '" + kScenes + "' -o /dev/null/x");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.out, "");
    expect_lab_message(outcome.err, "cannot create the folder '/dev/null/x'");
    expect_lab_message(outcome.err, "--out");

    // Also the folder of each experiment.
    std::filesystem::create_directory(path("out"));
    for (const char* name : {"planes", "biased", "lines-large", "lines-visibility"}) {
        std::ofstream(path("out/" + std::string(name))) << "a file";
        const Outcome late = run_lab("reproduce " + std::string(name) + " --scenes '" + kScenes + "' -o out");
        EXPECT_EQ(late.exit_code, 1) << name;
        EXPECT_EQ(late.out, "") << name;
        expect_lab_message(late.err, "cannot create the folder 'out/" + std::string(name) + "/quick'");
    }
    for (const char* file : {"out/wall/quick/numbers.json", "out/index.html"}) {
        std::filesystem::create_directories(path(file));
        const Outcome page = run_lab("reproduce wall --scenes '" + kScenes + "' -o out");
        EXPECT_EQ(page.out, "");
        expect_lab_message(page.err, "cannot write '" + std::string(file) + "'");
        std::filesystem::remove(path(file));
    }
}

/// A limit on the size of files lets the large image fail once everything is rendered.
TEST_F(OutputFiles, AnImageThatCannotBeWrittenDoesNotLoseTheOthers) {
    const Outcome outcome =
        run("render '" + kScenes +
                "/room.pbrt' --resolution 160x120 --spp 1 -o a.pfm -o b.png -o c.pfm --json report.json",
            "ulimit -f 200;"); // 100 or 200 kB
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.out, "b.png\n");
    EXPECT_EQ(image::read_image(path("b.png")).width, 160);
    EXPECT_NE(read("report.json").find("\"seconds\""), std::string::npos);
    for (const char* name : {"'a.pfm'", "'c.pfm'"})
        EXPECT_NE(outcome.err.find(std::string("cannot write ") + name), std::string::npos) << outcome.err;
}

} // namespace

} // namespace nusselt
