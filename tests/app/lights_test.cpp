// Light rigs on the command line.

#include "program.h"

#include "image/io.h"

#include <nlohmann/json.hpp>

namespace nusselt {

namespace {

class LightRigs : public CommandLine {
protected:
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name), std::ios::binary) << text;
    }
};

TEST_F(LightRigs, AMovedLightEqualsThatOfAMovedSceneFile) {
    const auto scene = [](const std::string& transform) {
        return "Film \"rgb\" \"integer xresolution\" 32 \"integer yresolution\" 32\n"
               "LookAt 0 2 5  0 0.5 0  0 1 0 Camera \"perspective\" WorldBegin Material \"diffuse\"\n"
               "Shape \"polygon\" \"point3 P\" [ -2 0 2  2 0 2  2 0 -2  -2 0 -2 ] AttributeBegin\n" +
               transform +
               " AreaLightSource \"diffuse\" \"rgb L\" [ 1 2 3 ]\n"
               "Shape \"polygon\" \"point3 P\" [ 0 2 0  1 2 0  1 2 1  0 2 1 ] AttributeEnd\n";
    };
    write("here.pbrt", scene(""));
    write("there.pbrt", scene("Translate -0.5 -1 0.25"));
    write("move.json", R"({"version": 1, "lights": [{"light": 0, "move": [-0.5, -1, 0.25]}]})");
    write("twice.json", R"({"version": 1, "lights": [{"light": "*", "scale_radiance": 2}]})");
    for (const char* arguments :
         {"here.pbrt -o here.exr", "there.pbrt -o there.exr", "here.pbrt --lights move.json -o moved.exr",
          "here.pbrt --lights move.json --lights twice.json -o both.exr"})
        ASSERT_EQ(run(std::string("render -q --spp 4 ") + arguments).exit_code, 0) << arguments;
    const image::Image there = image::read_image(path("there.exr"));
    EXPECT_EQ(image::read_image(path("moved.exr")).pixels, there.pixels);
    EXPECT_NE(image::read_image(path("here.exr")).pixels, there.pixels);
    // Light is linear, and factors of two are exact.
    const image::Image both = image::read_image(path("both.exr"));
    for (std::size_t i = 0; i < there.pixels.size(); ++i) EXPECT_EQ(both.pixels[i], 2 * there.pixels[i]);
}

TEST_F(LightRigs, PrintedLightsChangeNothing) {
    const std::string room = "'" + kScenes + "/room.pbrt' ";
    const Outcome lights = run("lights " + room);
    ASSERT_EQ(lights.exit_code, 0) << lights.err;
    EXPECT_EQ(nlohmann::json::parse(lights.out)["lights"].size(), 3u);
    write("rig.json", lights.out);
    EXPECT_EQ(run("lights --lights rig.json " + room).out, lights.out);
    for (const char* rest : {"-o a.exr", "-o b.exr --lights rig.json"})
        ASSERT_EQ(run("render -q --resolution 48x27 " + room + rest).exit_code, 0) << rest;
    EXPECT_EQ(image::read_image(path("a.exr")).pixels, image::read_image(path("b.exr")).pixels);

    write("one.json", R"({"version": 1, "lights": [{"light": "poly*", "remove": true}]})");
    const Outcome info = run("info --lights one.json " + room);
    EXPECT_EQ(info.exit_code, 0);
    EXPECT_NE(info.out.find("1 line light\n"), std::string::npos) << info.out;
}

TEST_F(LightRigs, AreNamedInFiles) {
    const std::string room = "'" + kScenes + "/room.pbrt' ";
    write("dim.json", R"({"version": 1, "lights": [{"light": "*", "scale_radiance": 0.5}]})");
    write("off.json", R"({"version": 1, "lights": [{"light": 0, "enabled": false}]})");
    ASSERT_EQ(run("render -q --resolution 48x27 --json a.json -o a.exr " + room).exit_code, 0);
    ASSERT_EQ(run("render -q --resolution 48x27 --json b.json -o b.exr --lights dim.json --lights '" +
                  path("off.json") + "' " + room)
                  .exit_code,
              0);
    EXPECT_EQ(image::read_exr_metadata(path("a.exr")).count("light_rigs"), 0u);
    EXPECT_EQ(image::read_exr_metadata(path("b.exr")).at("light_rigs"), "dim.json, off.json");
    EXPECT_EQ(nlohmann::json::parse(read("a.json"))["light_rigs"], nlohmann::json::array());
    EXPECT_EQ(nlohmann::json::parse(read("b.json"))["light_rigs"],
              (nlohmann::json{"dim.json", path("off.json")}));
}

TEST_F(LightRigs, WrongRigsAreErrors) {
    write("rig.json", R"({"version": 1, "lights": [{"light": 0, "radiance": [1, "a", 2]}]})");
    write("wrong.pbrt", "this is no scene");
    for (const char* command : {"render --lights rig.json ", "lights --lights rig.json "}) {
        // The rig is read first: otherwise the wrong scene would be the error.
        const Outcome wrong = run(std::string(command) + "wrong.pbrt");
        EXPECT_EQ(wrong.exit_code, 1) << command;
        expect_message(wrong.err, "rig.json: lights[0].radiance[1]: must be a number from 0 to 1e+30, found");
    }
    const Outcome missing = run("render --lights none.json '" + kScenes + "/room.pbrt'");
    EXPECT_EQ(missing.exit_code, 1);
    expect_message(missing.err, "no such file: 'none.json'");
}

} // namespace

} // namespace nusselt
