/// Scripts that change lights as the mouse does.

#include "script_fixture.h"

#include "viewer/lights/picking.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace nusselt::viewer {
namespace {

using scene::Double3;

class LightScriptTest : public ScriptTest {
protected:
    /// Runs commands, also after others that closed the viewer, and renders a frame.
    void run(const std::string& text, Viewer& viewer) const {
        viewer.is_closing = false;
        play(write(text + "frames 1\nquit\n"), viewer);
    }

    /// With a technique whose shaders drivers compile quickly.
    Viewer make_viewer() const {
        render::RenderSettings settings;
        settings.technique = render::Technique::ltc_analytic;
        return ScriptTest::make_viewer(settings);
    }

    static FilmPosition position_of(const Viewer& viewer, const Double3& point) {
        return seen_at(viewer.state.camera.camera(), point).value();
    }
    static Double3 center(const Viewer& viewer) {
        return viewer.state.edits.center(viewer.session.loaded(), *viewer.state.selected_light);
    }
    /// The commands of a drag.
    static std::string drag(FilmPosition from, FilmPosition to) {
        return fmt::format("press {} {}\ndrag {} {}\nrelease\n", from.x, from.y, to.x, to.y);
    }
};

TEST_F(LightScriptTest, ChangesLightsInAllWays) {
    Viewer viewer = make_viewer();
    run("light 0\nlight-turn 0 0 2 30\nlight-kelvin 3000\nlight-add tube\nlight-radiance 1 2 3\n", viewer);
    EXPECT_EQ(viewer.message, "");
    EXPECT_EQ(viewer.state.edits.get(0).turn, (Double3{0, 0, 30}));
    EXPECT_EQ(viewer.state.edits.get(0).colour, LightColour(Temperature{3000}));
    ASSERT_EQ(viewer.state.selected_light, std::size_t{1});
    EXPECT_EQ(viewer.state.edits.get(1).colour, LightColour(scene::Float3{1, 2, 3}));
    EXPECT_EQ(viewer.state.edits.get(1).added->shape, LightShape::tube);
    // It is in the middle of the image.
    EXPECT_NEAR(position_of(viewer, center(viewer)).x, 12, 1e-3);
    EXPECT_NEAR(position_of(viewer, center(viewer)).y, 10, 1e-3);
    run("light-remove\nlight 0\nlight-remove\n", viewer);
    EXPECT_TRUE(viewer.state.edits.lights(viewer.session.loaded()).empty());
    for (const float value : viewer.session.image(Side::left).pixels) EXPECT_EQ(value, 0);
}

TEST_F(LightScriptTest, MovesTurnsAndScalesSpheresAndDisks) {
    Viewer viewer = make_viewer();
    std::vector<float> before;
    for (const char* const commands :
         {"light 0\nlight-switch off\nlight-add sphere\n", "light-move 0.2 0.1 0\n", "light-size 0.5\n",
          "light-add disk\nlight 1\nlight-switch off\n", "light 2\nlight-turn 0 0 1 60\n"}) {
        SCOPED_TRACE(commands);
        run(commands, viewer);
        EXPECT_EQ(viewer.message, "");
        const std::vector<float> pixels = viewer.session.image(Side::left).pixels;
        EXPECT_GT(*std::max_element(pixels.begin(), pixels.end()), 0.01f);
        EXPECT_NE(pixels, before);
        before = pixels;
    }
    EXPECT_EQ(viewer.state.edits.get(1).size, 0.5);
}

/// Without a frame: drivers take long to compile shaders for images and maps.
TEST_F(LightScriptTest, ExchangesFilesAndUndoesIt) {
    Viewer viewer = make_viewer();
    const std::filesystem::path folder =
        std::filesystem::path(nusselt_test::kSourceFolder) / "tests/scene/rigs";
    const auto file = [&](const char* name) { return (folder / name).string() + "\n"; };
    const auto edit = [&] { return viewer.state.edits.get(0); };
    const auto run_only = [&](const std::string& text) {
        viewer.is_closing = false;
        play(write(text + "quit\n"), viewer);
    };
    run_only("light 0\nlight-image " + file("red-and-blue.pfm"));
    ASSERT_NE(edit().image.image, nullptr);
    EXPECT_EQ(viewer.files.inputs.back(), folder / "red-and-blue.pfm");
    run_only("undo\n");
    EXPECT_EQ(edit().image.image, nullptr);
    run_only("redo\nundo\nlight 0\nlight-profile " + file("lambert.ies") + "light-profile-turn 30\n");
    ASSERT_NE(edit().profile.luminaire, nullptr);
    EXPECT_EQ(edit().profile.angle, 30);
    run_only("light-honeycomb 30 40\n");
    EXPECT_EQ(edit().profile.honeycomb, (scene::HoneycombAngles{30, 40}));
    run_only("light-spread 50\nlight-map-turn 0 2 0 20\n");
    EXPECT_EQ(edit().profile.honeycomb, std::nullopt);
    EXPECT_EQ(edit().profile.spread, 50);
    EXPECT_EQ(edit().map_turn, (Double3{0, 20, 0}));
    run_only("undo\nundo\nundo\n");
    EXPECT_EQ(edit().profile.honeycomb, std::nullopt);
    EXPECT_EQ(edit().profile.angle, 30);
    viewer.is_closing = false;
    EXPECT_NE(error_of("light-profile " + file("nowhere.ies"), viewer).find("nowhere.ies"),
              std::string::npos);
    EXPECT_NE(error_of("light-map " + file("wide.pfm"), viewer).find("found 3 x 1"), std::string::npos);
    EXPECT_NE(error_of("light-spread 200\n", viewer).find("must be a number from 0.01 to 180"),
              std::string::npos);
}

TEST_F(LightScriptTest, UndoesAndRepeats) {
    Viewer viewer = make_viewer();
    run("light 0\nlight-size 2\nlight-brightness 3\nlight-add panel\nundo\nundo\n", viewer);
    EXPECT_EQ(viewer.state.edits.get(0).size, 2);
    EXPECT_EQ(viewer.state.edits.get(0).brightness, 1);
    EXPECT_EQ(viewer.state.selected_light, std::nullopt) << "the new light, which was selected, is gone";
    run("redo\nredo\n", viewer);
    EXPECT_EQ(viewer.state.edits.get(0).brightness, 3);
    EXPECT_EQ(viewer.state.edits.lights(viewer.session.loaded()).size(), 2u);
    run("redo\n", viewer);
    EXPECT_NE(viewer.message.find("nothing to redo"), std::string::npos);
    run("undo\nundo\nundo\n", viewer);
    EXPECT_TRUE(viewer.state.edits.empty());
    run("undo\n", viewer);
    EXPECT_NE(viewer.message.find("nothing to undo"), std::string::npos);
}

TEST_F(LightScriptTest, EditsThatFailAreNotUndone) {
    Viewer viewer = make_viewer();
    run("light 0\nlight-size 2\n", viewer);
    viewer.state.edits.set(0, {{1e300, 0, 0}, 1, 1, true});
    viewer.finish_edit();
    viewer.next_frame();
    EXPECT_NE(viewer.message, "");
    EXPECT_EQ(viewer.state.edits.get(0).size, 2);
    run("undo\n", viewer);
    EXPECT_TRUE(viewer.state.edits.empty());
}

TEST_F(LightScriptTest, SettingsThatFailLeaveTheHistory) {
    Viewer viewer = make_viewer();
    run("light 0\nlight-size 2\nlight-size 3\nundo\n", viewer);
    viewer.state.of(Side::left).strategies = render::Strategies::diffuse_ggx; // does not fit the technique
    viewer.next_frame();
    EXPECT_NE(viewer.message, "");
    run("redo\n", viewer);
    EXPECT_EQ(viewer.state.edits.get(0).size, 3);
    run("undo\n", viewer);
    EXPECT_EQ(viewer.state.edits.get(0).size, 2);
}

TEST_F(LightScriptTest, SelectsAndDragsLights_AsOneAction) {
    Viewer viewer = make_viewer();
    const FilmPosition from = position_of(viewer, viewer.state.edits.center(viewer.session.loaded(), 0));
    const FilmPosition to = {from.x - 6, from.y + 5};
    run(fmt::format("press {} {}\ndrag {} {}\ndrag {} {}\nrelease\n", from.x, from.y, from.x + 8, from.y,
                    to.x, to.y),
        viewer);
    ASSERT_EQ(viewer.state.selected_light, std::size_t{0});
    EXPECT_NEAR(position_of(viewer, center(viewer)).x, to.x, 1e-3);
    EXPECT_NEAR(position_of(viewer, center(viewer)).y, to.y, 1e-3);
    run("undo\n", viewer);
    EXPECT_TRUE(viewer.state.edits.empty());
    run(drag({1, 1}, {9, 9}), viewer);
    EXPECT_EQ(viewer.state.selected_light, std::nullopt);
}

TEST_F(LightScriptTest, HandlesMoveAndTurnTheLight) {
    Viewer viewer = make_viewer();
    run("light 0\nlight-move 0 -1 0\n", viewer);
    const scene::Camera camera = viewer.state.camera.camera();
    // The film is small: the handles of a larger one are found more easily.
    const LightHandles handles = selected_handles(viewer).value();
    const Double3 tip = handles.center + handles.length * Double3{0, 1, 0};
    const Double3 goal = handles.center + 6 * handles.length * Double3{0, 1, 0};
    Pointer pointer;
    pointer.press(position_of(viewer, tip), 0.01, viewer);
    ASSERT_EQ(pointer.handle(), (Handle{HandleAction::move, 1}));
    pointer.move_to(position_of(viewer, goal), viewer);
    pointer.release(viewer);
    EXPECT_LT(length(viewer.state.edits.get(0).move - (Double3{0, -1, 0} + (goal - tip))), 1e-3);

    const LightHandles moved = selected_handles(viewer).value();
    const auto ring = moved.lines({HandleAction::turn, 2}, camera);
    pointer.press(ring[6].first, 0.01, viewer);
    ASSERT_EQ(pointer.handle(), (Handle{HandleAction::turn, 2}));
    pointer.move_to(ring[9].first, viewer);
    pointer.release(viewer);
    const Double3 turn = viewer.state.edits.get(0).turn;
    EXPECT_NEAR(std::abs(turn.z), 360.0 * 3 / 48, 0.1);
    EXPECT_NEAR(std::abs(turn.x) + std::abs(turn.y), 0, 1e-9);
}

TEST_F(LightScriptTest, OrbitsAboutTheSelectedLight) {
    Viewer viewer = make_viewer();
    const FilmPosition before = position_of(viewer, viewer.state.edits.center(viewer.session.loaded(), 0));
    const Double3 position = viewer.state.camera.position();
    run("light 0\norbit 20 10\n", viewer);
    EXPECT_NEAR(position_of(viewer, center(viewer)).x, before.x, 0.2);
    EXPECT_NEAR(position_of(viewer, center(viewer)).y, before.y, 0.2);
    EXPECT_NEAR(length(viewer.state.camera.position() - center(viewer)), length(position - center(viewer)),
                1e-4);
    EXPECT_GT(length(viewer.state.camera.position() - position), 0.1);
}

} // namespace
} // namespace nusselt::viewer
