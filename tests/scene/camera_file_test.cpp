#include "base/temporary_folder.h"
#include "common/source_folder.h"
#include "scene/rig/camera_file.h"

#include "scene/import/importers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace nusselt::scene {

namespace {

/// A file of its own, for tests run at the same time.
std::filesystem::path write(const std::string& text) {
    static const nusselt::base::TemporaryFolder kFolder;
    const std::filesystem::path path = kFolder / "camera.json";
    std::ofstream(path) << text;
    return path;
}

std::string message_of(const std::string& text) {
    const std::filesystem::path path = write(text);
    try {
        static_cast<void>(read_camera_file(path));
    } catch (const std::runtime_error& error) {
        return std::string(error.what()).substr(path.string().size());
    }
    return "no error";
}

void expect_near(const Float3& a, const Float3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-7f);
    EXPECT_NEAR(a.y, b.y, 1e-7f);
    EXPECT_NEAR(a.z, b.z, 1e-7f);
}

TEST(CameraFile, ReadsWhatItWrites) {
    FilmedCamera view{{}, 640, 360};
    view.camera.origin = {1.25f, -2, 0.1f};
    view.camera.corner = {-0.5f, 0.3f, 1};
    view.camera.right = {1.0f / 640, 0, 0.25f / 640};
    view.camera.down = {0, -0.6f / 360, 0};
    view.camera.origin_right = {0.5f / 640, 0, 0};
    view.camera.origin_down = {0, 0.25f / 360, 0};
    const FilmedCamera read = read_camera_file(write(to_camera_text(view)));
    EXPECT_EQ(read.width, 640);
    EXPECT_EQ(read.height, 360);
    expect_near(read.camera.origin, view.camera.origin);
    expect_near(read.camera.corner, view.camera.corner);
    expect_near(read.camera.right, view.camera.right);
    expect_near(read.camera.down, view.camera.down);
    expect_near(read.camera.origin_right, view.camera.origin_right);
    expect_near(read.camera.origin_down, view.camera.origin_down);
}

TEST(CameraFile, ReplacesTheCropToo) {
    Scene scene = load_scene(std::filesystem::path(nusselt_test::kSourceFolder) / "scenes/room.pbrt");
    scene.film.crop = PixelBounds{1, 2, 3, 4};
    apply_camera({scene.camera, 32, 16}, scene);
    EXPECT_EQ(scene.film.width, 32);
    EXPECT_EQ(scene.film.height, 16);
    EXPECT_FALSE(scene.film.crop.has_value());
}

TEST(CameraFile, SaysWhatIsWrong) {
    const std::string camera = R"("camera": {"origin": [0, 0, 0], "corner": [0, 0, 1], )";
    EXPECT_EQ(message_of("{\"version\": 1, \"film\": [64, 48]}"), ": must have the field \"camera\"");
    EXPECT_NE(message_of("{\"version\": 1, \"film\": [64], " + camera +
                         "\"right\": [1, 0, 0], \"down\": [0, 1, 0]}}")
                  .find("film: must be width and height"),
              std::string::npos);
    EXPECT_NE(message_of("{\"version\": 1, \"film\": [0, 48], " + camera +
                         "\"right\": [1, 0, 0], \"down\": [0, 1, 0]}}")
                  .find("film[0]"),
              std::string::npos);
    EXPECT_NE(message_of("{\"version\": 1, \"film\": [64, 48], " + camera +
                         "\"right\": [1, 0, 0], \"down\": [-2, 0, 0]}}")
                  .find("must not be parallel"),
              std::string::npos);
    EXPECT_NE(message_of("{\"version\": 1, \"film\": [64, 48], " + camera + "\"down\": [-2, 0, 0]}}")
                  .find("must have the field \"right\""),
              std::string::npos);
}

TEST(CameraFile, RefusesDirectionsWhoseSquaresAreNoNumbers) {
    for (const std::string size : {"1e-12", "1e12"})
        EXPECT_NE(
            message_of(
                "{\"version\": 1, \"film\": [1, 1], \"camera\": {\"origin\": [0, 0, 0], \"corner\": [0, 0, " +
                size + "], \"right\": [" + size + ", 0, 0], \"down\": [0, " + size + ", 0]}}")
                .find("between 1e-9 and 1e9"),
            std::string::npos)
            << size;
}

TEST(CameraFile, RefusesRaysWithoutADirection) {
    const std::string message = message_of(
        R"({"version": 1, "film": [64, 48], "camera": {"origin": [0, 0, 0], "corner": [0, 0, 0],
            "right": [0, 0, 0], "down": [0, 0, 0], "origin_right": [1, 0, 0], "origin_down": [0, 1, 0]}})");
    EXPECT_EQ(message, ": camera.corner: must not be zero where rays are parallel");
}

TEST(CameraFile, RefusesRaysInOnePlane) {
    for (const char* corner : {"[0, 0, 0]", "[-1, -1, 0]"}) {
        const std::string message =
            message_of(R"({"version": 1, "film": [64, 48], "camera": {"origin": [0, 0, 0], "corner": )" +
                       std::string(corner) + R"(, "right": [2, 0, 0], "down": [0, 2, 0]}})");
        EXPECT_EQ(message, ": camera: corner, right and down must not lie in one plane");
    }
}

} // namespace

} // namespace nusselt::scene
