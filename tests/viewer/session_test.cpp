/// The images of the viewer, without its window.

#include "base/temporary_folder.h"
#include "common/source_folder.h"
#include "viewer/session.h"

#include "gpu_test.h"

#include "image/metrics.h"
#include "image/srgb.h"
#include "render/film.h"
#include "render_vulkan/frame_records.h"
#include "render_vulkan/renderer.h"
#include "scene/import/importers.h"
#include "viewer/viewer.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace nusselt::viewer {
namespace {

using render_vulkan::ShadowRays;

constexpr int kWidth = 48;
constexpr int kHeight = 40;

scene::Scene load(const char* name) {
    scene::Scene scene =
        scene::load_scene(std::filesystem::path(nusselt_test::kSourceFolder) / "scenes" / name);
    render::resize_film(scene, kWidth, kHeight);
    return scene;
}

class SessionTest : public parity::GpuTest {
protected:
    Viewer make_viewer(const char* scene_name = "cornell-panel.pbrt", int samples = 2) const {
        render::RenderSettings settings;
        settings.samples = samples;
        return {device(), load(scene_name), ShadowRays::bvh, settings, {scene_name, {}, {}, {}}};
    }
};

TEST_F(SessionTest, OneFrameIsTheImageOfTheRenderer) {
    Viewer viewer = make_viewer();
    viewer.next_frame();
    viewer.next_frame();
    viewer.state.accumulates = false;
    viewer.next_frame();
    EXPECT_EQ(viewer.session.frames(Side::left), 1u);
    EXPECT_EQ(viewer.session.seed(Side::left), 2u);
    render::RenderSettings settings = viewer.state.of(Side::left);
    settings.camera_rays = 1;
    settings.seed = viewer.session.seed(Side::left);
    render_vulkan::VulkanRenderer renderer(device(), viewer.session.loaded(), ShadowRays::bvh);
    EXPECT_EQ(viewer.session.image(Side::left).pixels, renderer.render(settings).image.pixels);
}

TEST_F(SessionTest, BeginsAgainWheneverTheImageChanges) {
    Viewer viewer = make_viewer();
    const auto frames_after = [&](const auto& change) {
        for (int i = 0; i < 3; ++i) viewer.next_frame();
        EXPECT_GE(viewer.session.frames(Side::left), 3u);
        change();
        viewer.next_frame();
        EXPECT_EQ(viewer.message, "");
        return viewer.session.frames(Side::left);
    };
    EXPECT_GE(frames_after([&] { viewer.state.exposure = 1; }), 4u);
    EXPECT_EQ(frames_after([&] { viewer.state.camera.turn(0.1, 0); }), 1u);
    EXPECT_EQ(frames_after([&] { viewer.state.of(Side::left).samples = 1; }), 1u);
    EXPECT_EQ(frames_after([&] { choose_technique(render::Technique::area, viewer.state.of(Side::left)); }),
              1u);
    LightEdit brighter;
    brighter.brightness = 2;
    EXPECT_EQ(frames_after([&] { viewer.state.edits.set(0, brighter); }), 1u);
    EXPECT_GE(frames_after([&] { viewer.state.of(Side::right).samples = 1; }), 4u)
        << "the other image does not matter";
}

TEST_F(SessionTest, ShowsLightsThatWereSwitchedOff_AndMoved) {
    Viewer viewer = make_viewer();
    viewer.next_frame();
    const image::Image before = viewer.session.image(Side::left);
    LightEdit off;
    off.is_enabled = false;
    viewer.state.edits.set(0, off);
    viewer.next_frame();
    for (const float value : viewer.session.image(Side::left).pixels) EXPECT_EQ(value, 0);
    LightEdit moved;
    moved.move = {0, -0.5, 0};
    viewer.state.edits.set(0, moved);
    viewer.next_frame();
    EXPECT_GT(image::compare(viewer.session.image(Side::left), before).relative_rmse, 0.1);
    viewer.state.edits.set(0, {});
    viewer.next_frame();
    EXPECT_EQ(viewer.session.image(Side::left).pixels, before.pixels);
}

TEST_F(SessionTest, EditsOfLightsCompileNothingAgain) {
    Viewer viewer = make_viewer();
    viewer.next_frame();
    const std::size_t shaders = device().shaders().size();
    EXPECT_GE(shaders, 3u) << "to draw, to shade and to show";
    LightEdit moved;
    moved.move = {0, -0.5, 0};
    viewer.state.edits.set(0, moved);
    viewer.next_frame();
    viewer.state.reduction = 4;
    viewer.session.render(viewer.state);
    EXPECT_EQ(device().shaders().size(), shaders);
}

TEST_F(SessionTest, FramesThatAreInterruptedBecomeTheSame) {
    Viewer whole = make_viewer();
    for (int i = 0; i < 3; ++i) whole.next_frame();
    Viewer pieces = make_viewer();
    int calls = 0;
    for (int frames = 0; frames < 3; ++calls) {
        pieces.next_frame(0);
        frames += pieces.is_frame_finished ? 1 : 0;
        EXPECT_EQ(pieces.session.frames(Side::left), static_cast<std::uint32_t>(frames));
    }
    EXPECT_GT(calls, 3) << "a call renders some rows";
    EXPECT_EQ(pieces.session.image(Side::left).pixels, whole.session.image(Side::left).pixels);
    EXPECT_EQ(pieces.session.picture().pixels(), whole.session.picture().pixels());

    // Rows that have a frame more than others are not brighter.
    render_vulkan::DeviceScene scene(device(), pieces.session.loaded(), ShadowRays::bvh);
    render::RenderSettings settings;
    settings.technique = render::Technique::ltc_analytic;
    settings.pixel_position = render::PixelPosition::center;
    settings.camera_rays = 1;
    render_vulkan::Accumulator image(scene, settings);
    const auto frame = render_vulkan::FrameRecords(scene.film(), settings).make(0);
    image.add(frame);
    const image::Image once = image.mean();
    image.begin(frame);
    image.add_rows(9);
    EXPECT_EQ(image.rows_ahead(), 16u);
    EXPECT_EQ(image.frames(), 1u);
    EXPECT_EQ(image.mean().pixels, once.pixels);
    render_vulkan::DisplayPass display(device(), kWidth, kHeight);
    display.show(image, image, image, {});
    const std::vector<std::uint32_t> partly = display.pixels();
    image.restart(settings);
    image.add(frame);
    display.show(image, image, image, {});
    EXPECT_EQ(display.pixels(), partly);
}

TEST_F(SessionTest, ShowsTheSameInFewerPixelsWhileSomethingMoves) {
    Viewer viewer = make_viewer();
    viewer.next_frame();
    viewer.state.camera.turn(0.1, 0);
    viewer.state.accumulates = false;
    // All pixels of a frame share their offset from the centre, hence the mean over many frames. Lights would outshine the
    // rest; limited for each camera ray, they are the same share of images of any size.
    const auto mean_of_frames = [&](const auto& render) {
        constexpr int kFrames = 48;
        double sum = 0;
        std::size_t count = 0;
        for (int i = 0; i < kFrames; ++i) {
            render();
            const image::Image image = viewer.session.image(Side::left);
            for (const float value : image.pixels) sum += std::min(static_cast<double>(value), 1.0);
            count += image.pixels.size();
        }
        return sum / static_cast<double>(count);
    };
    viewer.state.reduction = 4;
    const double small = mean_of_frames([&] {
        viewer.session.render(viewer.state);
        viewer.session.show(viewer.state);
    });
    EXPECT_EQ(viewer.session.image(Side::left).width, kWidth / 4);
    EXPECT_EQ(viewer.session.image(Side::left).height, kHeight / 4);
    EXPECT_EQ(viewer.session.picture().width(), kWidth / 4);
    const double full = mean_of_frames([&] { viewer.next_frame(); });
    EXPECT_EQ(viewer.session.image(Side::left).width, kWidth) << "at rest, all pixels are rendered";
    EXPECT_NEAR(small, full, 0.05 * full);
}

TEST_F(SessionTest, KeepsThePictureOfAMotionUntilTheFirstFrameIsFinished) {
    for (const bool turns_again : {false, true}) {
        SCOPED_TRACE(turns_again);
        Viewer viewer = make_viewer();
        viewer.state.reduction = 2;
        viewer.session.render(viewer.state);
        viewer.session.show(viewer.state);
        viewer.state.reduction = 1;
        if (turns_again) viewer.state.camera.turn(0.1, 0);
        EXPECT_FALSE(viewer.session.render(viewer.state, 0));
        viewer.session.show(viewer.state);
        EXPECT_EQ(viewer.session.frames(Side::left), 0u);
        // The picture of another camera is no stand-in.
        EXPECT_EQ(viewer.session.picture().width(), turns_again ? kWidth : kWidth / 2);
        while (!viewer.session.render(viewer.state, 0)) {
        }
        viewer.session.show(viewer.state);
        EXPECT_EQ(viewer.session.picture().width(), kWidth);
    }
}

TEST_F(SessionTest, RigsThatWereLoadedAreNotAppliedAgain) {
    Viewer viewer = make_viewer();
    LightEdit moved;
    moved.move = {0, -0.2, 0};
    viewer.state.edits.set(0, moved);
    viewer.next_frame();
    const base::TemporaryFolder folder;
    const std::filesystem::path rig = folder / "rig.json";
    save_lights(rig, viewer.session, viewer.state, viewer.files);
    viewer.load_lights(rig);
    LightEdit far;
    far.move = {1e300, 0, 0};
    viewer.state.edits.set(0, far);
    viewer.next_frame();
    EXPECT_NE(viewer.message, "");
    EXPECT_TRUE(viewer.state.edits.empty());
}

TEST_F(SessionTest, RefusesWhatCannotBeDone_AndGoesOnAsBefore) {
    Viewer viewer = make_viewer();
    viewer.next_frame();
    LightEdit far;
    far.move = {1e300, 0, 0};
    viewer.state.edits.set(0, far);
    viewer.next_frame();
    EXPECT_NE(viewer.message, "");
    EXPECT_TRUE(viewer.state.edits.empty());
    EXPECT_GE(viewer.session.frames(Side::left), 1u);
}

TEST_F(SessionTest, WarnsOfLightsThatEditsLeaveDark) {
    Viewer viewer = make_viewer();
    viewer.next_frame();
    EXPECT_TRUE(viewer.session.warnings().empty());
    const base::TemporaryFolder folder;
    const std::filesystem::path profile = folder / "dark.ies";
    std::ofstream(profile)
        << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 1 1 0\n1 1 10\n0 45 90\n0\n0 0 0\n";
    LightEdit dark;
    dark.profile.luminaire = viewer.read_light_file(&scene::RigFiles::profile, profile);
    viewer.state.edits.set(0, dark);
    viewer.next_frame();
    ASSERT_EQ(viewer.session.warnings().size(), 1u);
    EXPECT_NE(viewer.session.warnings()[0].find("'dark.ies' is black"), std::string::npos)
        << viewer.session.warnings()[0];
    const std::filesystem::path rig = folder / "rig.json";
    save_lights(rig, viewer.session, viewer.state, viewer.files);
    viewer.state.edits.set(0, {});
    viewer.next_frame();
    EXPECT_TRUE(viewer.session.warnings().empty());
    viewer.load_lights(rig);
    EXPECT_EQ(viewer.session.warnings().size(), 1u);
}

/// Red, green or blue of a picture, 0 to 255.
int code_at(const render_vulkan::DisplayPass& picture, std::size_t pixel, std::size_t channel) {
    return static_cast<int>(picture.pixels()[pixel] >> (8 * channel) & 0xff);
}

TEST_F(SessionTest, ShowsBothImagesBesideEachOther) {
    Viewer viewer = make_viewer();
    viewer.state.is_split = true;
    viewer.state.wipe = 0.25;
    viewer.state.exposure = -1;
    choose_technique(render::Technique::area, viewer.state.of(Side::right));
    viewer.next_frame();
    const image::Image images[] = {viewer.session.image(Side::left), viewer.session.image(Side::right)};
    ASSERT_NE(images[0].pixels, images[1].pixels);
    for (std::size_t pixel = 0; pixel < std::size_t{kWidth} * kHeight; ++pixel) {
        const image::Image& image = images[pixel % kWidth < kWidth / 4 ? 0 : 1];
        for (std::size_t k = 0; k < 3; ++k) {
            const double expected = 255 * image::srgb_from_linear(std::min(
                                              0.5 * static_cast<double>(image.pixels[3 * pixel + k]), 1.0));
            ASSERT_NEAR(code_at(viewer.session.picture(), pixel, k), expected, 0.51)
                << "pixel " << pixel << ", channel " << k;
        }
    }
}

TEST_F(SessionTest, CompressesBrightness) {
    Viewer viewer = make_viewer();
    viewer.state.exposure = 3;
    viewer.next_frame();
    const image::Image image = viewer.session.image(Side::left);
    const auto filmic = [](double x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); };
    for (const render_vulkan::ToneCurve curve : render_vulkan::kToneCurves) {
        viewer.state.tone_curve = curve;
        viewer.session.show(viewer.state);
        for (std::size_t pixel = 0; pixel < std::size_t{kWidth} * kHeight; ++pixel) {
            const auto channel = [&](std::size_t k) {
                return 8 * static_cast<double>(image.pixels[3 * pixel + k]);
            };
            const double luminance = 0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2);
            for (std::size_t k = 0; k < 3; ++k) {
                const double mapped = curve == render_vulkan::ToneCurve::none ? channel(k)
                                      : curve == render_vulkan::ToneCurve::reinhard
                                          ? channel(k) / (1 + luminance)
                                          : filmic(channel(k));
                ASSERT_NEAR(code_at(viewer.session.picture(), pixel, k),
                            255 * image::srgb_from_linear(std::min(mapped, 1.0)), 0.51)
                    << name_of(curve) << ", pixel " << pixel << ", channel " << k;
            }
        }
    }
}

TEST_F(SessionTest, MeasuresErrorsAsMetricsDo) {
    Viewer viewer = make_viewer();
    viewer.state.is_split = true;
    choose_technique(render::Technique::area, viewer.state.of(Side::right));
    viewer.next_frame();
    EXPECT_EQ(viewer.session.errors().left, 0) << "without a reference there are none";
    viewer.state.renders_reference = true;
    for (int i = 0; i < 64; ++i) viewer.next_frame();
    EXPECT_EQ(viewer.session.reference_frames(), 64u);

    // The same reference once more.
    render_vulkan::DeviceScene scene(device(), viewer.session.loaded(), ShadowRays::bvh);
    const render::RenderSettings settings = reference_settings(viewer.state.of(Side::left));
    render_vulkan::Accumulator reference(scene, settings);
    for (std::uint32_t i = 0; i < 64; ++i) {
        render::RenderSettings frame = settings;
        frame.camera_rays = 1;
        frame.seed += i;
        reference.add(render_vulkan::FrameRecords(scene.film(), frame).make(0));
    }
    for (const Side side : kSides) {
        const double expected = image::compare(viewer.session.image(side), reference.mean()).rmse;
        const double measured =
            side == Side::left ? viewer.session.errors().left : viewer.session.errors().right;
        EXPECT_NEAR(measured, expected, 1e-4 * expected);
    }

    // 65 frames of one, 1 frame of the other.
    viewer.state.of(Side::right).seed = 1000;
    viewer.next_frame();
    EXPECT_LT(2 * viewer.session.errors().left, viewer.session.errors().right);
}

TEST_F(SessionTest, ErrorsAreBlackWhereThereAreNone_AndWhiteWhereAllIsWrong) {
    const render_vulkan::DeviceScene scene(device(), load("cornell-panel.pbrt"), ShadowRays::bvh);
    render::RenderSettings settings;
    settings.technique = render::Technique::ltc_analytic;
    render_vulkan::Accumulator reference(scene, settings);
    reference.add(render_vulkan::FrameRecords(scene.film(), settings).make(0));
    const render_vulkan::Accumulator black(scene, settings);
    render_vulkan::DisplayPass display(device(), kWidth, kHeight);
    display.show(reference, black, reference, {.wipe = 0.5, .shown = render_vulkan::Shown::error});
    const image::Image image = reference.mean();
    int bright = 0;
    for (std::size_t i = 0; i < std::size_t{kWidth} * kHeight; ++i) {
        const bool is_right = i % kWidth >= kWidth / 2;
        const float sum = image.pixels[3 * i] + image.pixels[3 * i + 1] + image.pixels[3 * i + 2];
        // Darker ones are judged as if they were a little brighter.
        if (is_right && sum < 1) continue;
        bright += is_right;
        for (std::size_t k = 0; k < 3; ++k) {
            if (is_right)
                EXPECT_GE(code_at(display, i, k), 248) << i;
            else
                EXPECT_EQ(code_at(display, i, k), 0) << i;
        }
    }
    EXPECT_GT(bright, kWidth);
}

} // namespace
} // namespace nusselt::viewer
