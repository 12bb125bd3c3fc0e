#include "script_fixture.h"

#include "image/io.h"

#include <sys/stat.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>

namespace nusselt::viewer {
namespace {

TEST_F(ScriptTest, SetsWhatAPersonSets) {
    Viewer viewer = make_viewer();
    const int frames = play(write("# a comment\n"
                                  "technique area  # and another\n"
                                  "right-technique solid_angle\n"
                                  "right-samples 3\n"
                                  "split 0.25\n\n"
                                  "exposure -1.5\n"
                                  "show error\n"
                                  "reference on\n"
                                  "frames 5\n"
                                  "quit\n"
                                  "exposure 2\n"),
                            viewer);
    EXPECT_EQ(frames, 5);
    EXPECT_EQ(viewer.state.of(Side::left).technique, render::Technique::area);
    EXPECT_EQ(viewer.state.of(Side::right).technique, render::Technique::solid_angle);
    EXPECT_EQ(viewer.state.of(Side::right).samples, 3);
    EXPECT_TRUE(viewer.state.is_split);
    EXPECT_EQ(viewer.state.wipe, 0.25);
    EXPECT_EQ(viewer.state.exposure, -1.5);
    EXPECT_EQ(viewer.state.shown, render_vulkan::Shown::error);
    EXPECT_EQ(viewer.session.frames(Side::left), 5u);
    EXPECT_EQ(viewer.session.reference_frames(), 5u);
}

TEST_F(ScriptTest, RefusesPipes_WithoutWaitingForTheirWriters) {
    const std::string pipe = path("pipe");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THROW(Script{std::filesystem::path(pipe)}, std::runtime_error);
}

TEST_F(ScriptTest, EditsLights_AndWritesWhatRendersTheSame) {
    Viewer viewer = make_viewer();
    play(write("light 0\nlight-move 0 -0.25 0\nlight-size 0.5\nlight-brightness 3\n"
               "turn 5 -3\nmove 0.1 0 0.2\nframes 2\n"
               "screenshot " +
               path("a.png") + "\nscreenshot " + path("a.exr") + "\nquit\n"),
         viewer);
    const LightEdit edit = viewer.state.edits.get(0);
    EXPECT_EQ(edit, (LightEdit{{0, -0.25, 0}, 0.5, 3, true}));
    EXPECT_EQ(image::read_image(path("a.exr")).pixels, viewer.session.image(Side::left).pixels);
    EXPECT_EQ(image::read_image(path("a.png")).width, 24);

    Viewer other = make_viewer();
    const std::string load =
        "load-camera " + path("a.camera.json") + "\nload-lights " + path("a.lights.json") + "\n";
    play(write(load + "frames 2\nquit\n"), other);
    const auto distance = [&](const scene::Float3& a, const scene::Float3& b) {
        return length(to_double(a) - to_double(b));
    };
    EXPECT_LT(distance(other.state.camera.camera().origin, viewer.state.camera.camera().origin), 1e-5);
    ASSERT_EQ(other.files.rigs.size(), 1u);
    const scene::Scene edited = viewer.state.edits.applied_to(viewer.session.loaded());
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_LT(distance(other.session.loaded().lights.of<scene::PolygonLight>()[0].vertices[i],
                           edited.lights.of<scene::PolygonLight>()[0].vertices[i]),
                  1e-6);
}

/// A rig that is saved over the one that was loaded would lose what that one changed.
TEST_F(ScriptTest, ReplacesNoFileThatWasRead) {
    const std::string rig = write_file("rig.camera.json", R"({"version": 1, "lights": []})");
    for (const std::string& save : {"save-lights " + rig, "save-camera " + rig, "window-screenshot " + rig,
                                    "screenshot " + path("rig.png")}) {
        Viewer viewer = make_viewer();
        EXPECT_NE(error_of("load-lights " + rig + "\nframes 1\n" + save + "\nquit\n", viewer)
                      .find("is an output and also an input"),
                  std::string::npos)
            << save;
    }
    EXPECT_EQ(std::filesystem::file_size(rig), 28u);
    EXPECT_FALSE(std::filesystem::exists(path("rig.png")));
}

TEST_F(ScriptTest, WritesBothImages) {
    Viewer viewer = make_viewer();
    play(write("split 0.5\nright-technique area\nframes 1\nscreenshot " + path("b.exr") + "\nquit\n"),
         viewer);
    EXPECT_EQ(image::read_image(path("b.exr")).pixels, viewer.session.image(Side::left).pixels);
    EXPECT_EQ(image::read_image(path("b-right.exr")).pixels, viewer.session.image(Side::right).pixels);
}

TEST_F(ScriptTest, ScreenshotsHaveFinishedFramesOfAllPixels) {
    Viewer whole = make_viewer();
    for (int i = 0; i < 2; ++i) whole.next_frame();
    Viewer viewer = make_viewer();
    viewer.save_screenshot(path("first.exr"));
    EXPECT_EQ(viewer.session.frames(Side::left), 1u);
    viewer.next_frame(0);
    ASSERT_FALSE(viewer.is_frame_finished);
    const std::string command = viewer.save_screenshot(path("second.exr"));
    EXPECT_NE(command.find("--spp 2 "), std::string::npos) << command;
    viewer.save_screenshot(path("again.exr"));
    for (const char* const name : {"second.exr", "again.exr"})
        EXPECT_EQ(image::read_image(path(name)).pixels, whole.session.image(Side::left).pixels) << name;

    viewer.state.camera.turn(0.1, 0);
    viewer.state.reduction = 4;
    viewer.session.render(viewer.state);
    viewer.session.show(viewer.state);
    ASSERT_EQ(viewer.session.picture().width(), 6u);
    for (const char* const name : {"moving.exr", "moving.png"}) {
        viewer.save_screenshot(path(name));
        EXPECT_EQ(image::read_image(path(name)).width, 24) << name;
    }
    EXPECT_EQ(viewer.session.frames(Side::left), 1u);
}

TEST_F(ScriptTest, CommandsNameTheirSettings) {
    Viewer viewer = make_viewer();
    viewer.state.of(Side::left).sample_order = render::SampleOrder::jittered;
    choose_strategies(render::Strategies::diffuse_ltc, viewer.state.of(Side::left));
    viewer.next_frame();
    const std::string command =
        command_of(viewer.session, viewer.state, viewer.files, "it's here.json", "rig.json", "out.exr");
    EXPECT_EQ(
        command,
        "nusselt render cornell-panel.pbrt --lights rig.json --camera 'it'\\''s here.json' --backend vulkan "
        "--shadow-rays bvh --technique projected_solid_angle --strategies diffuse+ltc --mis clamped_optimal "
        "--visibility-estimate 0.5 --sampler jittered --brdf material --spp 1 --camera-rays 1 --seed 0 "
        "-o out.exr");
    viewer.next_frame();
    viewer.next_frame();
    EXPECT_NE(command_of(viewer.session, viewer.state, viewer.files, "c.json", {}, "o.exr")
                  .find("--spp 3 --seed 0 -o"),
              std::string::npos);
    viewer.state.of(Side::left).mis = render::Mis::balance;
    EXPECT_NE(command_of(viewer.session, viewer.state, viewer.files, "c.json", {}, "o.exr")
                  .find("--mis balance --sampler"),
              std::string::npos);
}

TEST_F(ScriptTest, NamesTheLineOfAMistake) {
    Viewer viewer = make_viewer();
    viewer.next_frame();
    const auto expect = [&](const std::string& text, const std::string& place, const std::string& part) {
        const std::string error = error_of(text, viewer);
        EXPECT_NE(error.find("script.txt:" + place + ": "), std::string::npos) << error;
        EXPECT_NE(error.find(part), std::string::npos) << error;
    };
    expect("frames 1\nfly 3\n", "2", "unknown command 'fly'");
    expect("frames\n", "1", "needs 1 value, found 0");
    expect("frames 0\n", "1", "'0' must be a number from 1 to");
    expect("technique magic\n", "1", "unknown setting 'magic'; use one of area,");
    expect("samples 65\n", "1", "'65' must be a number from 1 to 64");
    expect("exposure nan\n", "1", "'nan' must be a number from");
    expect("light 7\n", "1", "'7' must be a number from 0 to 0");
    expect("light-size 2\n", "1", "no light is selected");
    expect("reference maybe\n", "1", "must be on or off");
    expect("screenshot nowhere.txt\n", "1", "nowhere.txt");
    expect("screenshot " + path("missing/all.png") + "\n", "1", "missing/all.png");
    expect("window-screenshot nowhere.txt\n", "1", "nowhere.txt");
    expect("frames 1\nwindow-screenshot " + path("missing/all.png") + "\n", "2", "missing/all.png");
    expect("load-camera missing.json\n", "1", "missing.json");
    expect("load-lights missing.json\n", "1", "missing.json");
    expect("tone-curve sepia\n", "1", "use one of none, reinhard, filmic");
    expect("light-add cube\n", "1", "use one of panel, tube, sphere, disk");
    expect("light-remove\n", "1", "no light is selected");
    expect("light 0\nlight-kelvin 100\n", "2", "'100' must be a number from 1000 to 40000");
    expect("light 0\nlight-turn 0 0 0 5\n", "2", "the axis must not be zero");
    try {
        const Script script(std::filesystem::path(path("no-script.txt")));
        FAIL() << "there is no such file";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("no-script.txt"), std::string::npos);
    }
}

TEST_F(ScriptTest, GoesOnWhenThereIsNothingToPrint) {
    Viewer viewer = make_viewer();
    testing::internal::CaptureStderr();
    EXPECT_EQ(play(write("frames 1\nprint-errors\nframes 1\nquit\n"), viewer), 2);
    const std::string error = testing::internal::GetCapturedStderr();
    EXPECT_NE(error.find("script.txt:2: no reference to compare with"), std::string::npos) << error;
    EXPECT_NE(viewer.message.find("no reference"), std::string::npos);
}

TEST_F(ScriptTest, PrintsTheSpeedOfFramesBeforeARig) {
    const std::string rig = write_file("rig.json", R"({"version": 1, "lights": []})");
    Viewer viewer = make_viewer();
    testing::internal::CaptureStdout();
    EXPECT_EQ(play(write("frames 1\nload-lights " + rig + "\nprint-speed\nquit\n"), viewer), 1);
    const std::string line = testing::internal::GetCapturedStdout();
    EXPECT_NE(line.find("frames per second, 24 x 20 pixels"), std::string::npos) << line;

    // A person may load a rig right after the last frame.
    Playback playback;
    playback.begin(1);
    viewer.next_frame();
    viewer.load_lights(rig);
    playback.note_frame(viewer.session);
    EXPECT_EQ(playback.timed.value().size.width, 24u);
}

TEST_F(ScriptTest, DoesNotTimeTheFrameOfAScreenshotOfTheWindow) {
    Viewer viewer = make_viewer();
    Playback playback;
    const auto run = [&](const char* name, const std::string& argument) {
        commands().at(name).run(viewer, playback, {argument});
        int frames = 0;
        for (; playback.frames_left > 0; ++frames) {
            viewer.next_frame();
            playback.note_frame(viewer.session);
        }
        return frames;
    };
    EXPECT_EQ(run("window-screenshot", path("first.png")), 1);
    EXPECT_FALSE(playback.timed);
    EXPECT_EQ(run("frames", "3"), 3);
    const double seconds = playback.timed.value().seconds;
    EXPECT_EQ(run("window-screenshot", path("second.png")), 1);
    EXPECT_EQ(playback.timed->count, 3);
    EXPECT_EQ(playback.timed->seconds, seconds);
}

TEST_F(ScriptTest, TurnsWhileFramesPass_InFewerPixels) {
    Viewer viewer = make_viewer();
    const scene::Double3 begin = viewer.state.camera.forward();
    play(write("frames 1\nturning 2 0\nframes 5\nscreenshot " + path("moving.exr") +
               "\nturning 0 0\nframes 1\nscreenshot " + path("still.exr") + "\nquit\n"),
         viewer);
    EXPECT_NEAR(dot(begin, viewer.state.camera.forward()), std::cos(10 * std::numbers::pi / 180), 1e-6);
    EXPECT_EQ(image::read_image(path("still.exr")).width, 24);
}

TEST_F(ScriptTest, SettingsThatDoNotFitGiveWay) {
    render::RenderSettings settings;
    choose_strategies(render::Strategies::diffuse_ltc, settings);
    choose_mis(render::Mis::optimal, settings);
    choose_strategies(render::Strategies::diffuse_ggx, settings);
    EXPECT_EQ(settings.mis, render::Mis::balance);
    choose_technique(render::Technique::area, settings);
    EXPECT_EQ(settings.strategies, render::Strategies::diffuse);
    choose_strategies(render::Strategies::diffuse_ggx, settings);
    EXPECT_EQ(settings.technique, render::Technique::projected_solid_angle);
    choose_mis(render::Mis::clamped_optimal, settings);
    EXPECT_EQ(settings.strategies, render::Strategies::diffuse_ltc);
    validate(settings);
}

} // namespace
} // namespace nusselt::viewer
