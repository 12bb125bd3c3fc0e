// Files of cameras on the command line.

#include "program.h"

#include "image/io.h"

namespace nusselt {

namespace {

class CameraFiles : public CommandLine {
protected:
    const std::string room_ = "'" + kScenes + "/room.pbrt'";
};

TEST_F(CameraFiles, WhatIsPrintedIsTheCameraOfTheScene) {
    const Outcome printed = run("camera " + room_ + " --resolution 40x30");
    ASSERT_EQ(printed.exit_code, 0) << printed.err;
    std::ofstream(path("view.json")) << printed.out;
    ASSERT_EQ(run("render -q " + room_ + " --camera view.json -o view.exr").exit_code, 0);
    ASSERT_EQ(run("render -q " + room_ + " --resolution 40x30 -o scene.exr").exit_code, 0);
    const image::Image view = image::read_image(path("view.exr"));
    const image::Image scene = image::read_image(path("scene.exr"));
    ASSERT_EQ(view.width, 40);
    ASSERT_EQ(view.height, 30);
    // Steps of a pixel are rounded when they are multiplied by their number: edges may move.
    std::size_t different = 0;
    for (std::size_t i = 0; i < view.pixels.size(); ++i)
        different += std::abs(view.pixels[i] - scene.pixels[i]) > 1e-3f * (1 + scene.pixels[i]) ? 1 : 0;
    EXPECT_LT(different, view.pixels.size() / 100);
}

TEST_F(CameraFiles, ErrorsNameTheFile) {
    const Outcome missing = run("render " + room_ + " --camera nowhere.json");
    EXPECT_EQ(missing.exit_code, 1);
    expect_message(missing.err, "nowhere.json");
    std::ofstream(path("broken.json")) << "{\"version\": 1}";
    const Outcome broken = run("render " + room_ + " --camera broken.json");
    EXPECT_EQ(broken.exit_code, 1);
    expect_message(broken.err, "broken.json: must have the field \"film\"");
}

TEST_F(CameraFiles, ImagesThatCannotBeRenderedHaveNoCamera) {
    for (const char* command : {"camera ", "render -q "}) {
        const Outcome outcome = run(command + room_ + " --resolution 65536x65536");
        EXPECT_EQ(outcome.exit_code, 1) << command;
        EXPECT_EQ(outcome.out, "") << command;
        expect_message(outcome.err, "65536 x 65536 pixels is not supported");
    }
}

TEST_F(CameraFiles, AreNotOverwritten) {
    std::ofstream(path("view.exr")) << run("camera " + room_).out;
    const Outcome outcome = run("render " + room_ + " --camera view.exr -o view.exr");
    EXPECT_EQ(outcome.exit_code, 1);
    expect_message(outcome.err, "is an output and also an input");
}

} // namespace

} // namespace nusselt
