/// The files that a scene names: missing ones are reported together, the others are known afterwards.

#include "scene_fixture.h"

#include <gtest/gtest.h>

#include <string>

namespace nusselt::scene {
namespace {

class NamedFilesTest : public SceneTest {};

const std::string kUsed = "\nShape \"plymesh\" \"string filename\" \"floor.ply\"\n";

TEST_F(NamedFilesTest, OfAllKindsAreReportedTogether) {
    EXPECT_EQ(
        error("Include \"geometry.pbrt\"\n"
              "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"wood.png\"\n"
              "Material \"matte\" \"texture Kd\" \"t\"\n"
              "AreaLightSource \"diffuse\" \"spectrum L\" \"lamp.spd\"\n"
              "Shape \"plymesh\" \"string filename\" \"lamp.ply\"\n"
              "AreaLightSource \"diffuse\" \"string filename\" \"screen.exr\"\n"
              "Shape \"plymesh\" \"string filename\" \"lamp.ply\""),
        "scene.pbrt:1: 5 files do not exist: 'geometry.pbrt' (scene.pbrt:1), 'lamp.spd' (scene.pbrt:4), "
        "'screen.exr' (scene.pbrt:6), 'lamp.ply' (scene.pbrt:5), 'wood.png' (scene.pbrt:2)");
}

TEST_F(NamedFilesTest, ComeBeforeMistakesThatMayFollowFromThem) {
    EXPECT_EQ(error("Include \"materials.pbrt\"\nNamedMaterial \"wood\""),
              "scene.pbrt:1: scene file 'materials.pbrt': no such file");
    // A mistake before the missing file is the first one.
    EXPECT_EQ(error("NamedMaterial \"wood\"\nInclude \"materials.pbrt\""),
              "scene.pbrt:1: material \"wood\" is not defined");
}

TEST_F(NamedFilesTest, ComeBeforeFilesThatCannotBeRead) {
    write("broken.ply", "nothing");
    EXPECT_EQ(error("Shape \"plymesh\" \"string filename\" \"broken.ply\"" + kUsed),
              "scene.pbrt:2: mesh file 'floor.ply': no such file");
}

TEST_F(NamedFilesTest, ThatExistAreKnown) {
    write("geometry.pbrt", "");
    write("lamp.spd", "400 1 700 1");
    const Scene scene = load("Include \"geometry.pbrt\"\nInclude \"./geometry.pbrt\"\n"
                             "AreaLightSource \"diffuse\" \"spectrum L\" \"lamp.spd\"\n" +
                             std::string(kTriangle));
    const std::vector<std::filesystem::path> expected = {folder_ / "scene.pbrt", folder_ / "geometry.pbrt",
                                                         folder_ / "lamp.spd"};
    EXPECT_EQ(scene.files, expected);
}

TEST_F(NamedFilesTest, ThatNothingUsesDoNotMatter) {
    load("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"wood.png\"\n" +
         std::string(kTriangle));
}

TEST_F(NamedFilesTest, AreNamedOnce) {
    EXPECT_EQ(error(kUsed + kUsed), "scene.pbrt:2: mesh file 'floor.ply': no such file");
}

TEST_F(NamedFilesTest, ThatAreVeryManyAreCounted) {
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text += "Shape \"plymesh\" \"string filename\" \"" + std::to_string(i) + ".ply\"\n";
    const std::string message = error(text);
    EXPECT_TRUE(message.starts_with("scene.pbrt:1: 1000 files do not exist: '0.ply' (scene.pbrt:1), "))
        << message;
    EXPECT_TRUE(message.ends_with(" more")) << message;
    EXPECT_LT(message.size(), 1000u);
    // One name may be longer than a message.
    const std::string name(5000, 'x');
    EXPECT_TRUE(error("Shape \"plymesh\" \"string filename\" \"" + name + "\"" + kUsed)
                    .starts_with("scene.pbrt:1: 2 files do not exist: 'xxx"));
}

} // namespace
} // namespace nusselt::scene
