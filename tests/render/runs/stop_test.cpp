// Renderings that are stopped at any time, within tiles too, and go on.

#include "scenes.h"

#include "base/temporary_folder.h"
#include "render/checkpoint.h"
#include "render/frame.h"
#include "render_cpu/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <vector>

namespace nusselt::render_test {
namespace {

using render::Frame;
using render::LayerKind;
using render::RenderSettings;
using Seconds = std::chrono::duration<double>;
using Clock = std::chrono::steady_clock;

constexpr int kSize = 24;

/// A rendering in several runs.
class Runs {
public:
    Runs(const scene::Scene& scene, const RenderSettings& settings, base::Isa isa)
        : settings_(settings), isa_(isa), renderer_(scene, 2), frame_(render::make_frame(scene, settings)) {
        frame_.begun.emplace();
    }

    /// Renders on, and requests a stop after some time.
    /// \returns how long it took to stop
    Seconds go_on_for(Seconds time) {
        std::atomic<bool> cancel = false;
        Clock::time_point request;
        std::thread thread([&] {
            std::this_thread::sleep_for(time);
            request = Clock::now();
            cancel = true;
        });
        go_on(&cancel);
        const Clock::time_point end = Clock::now();
        thread.join();
        return end - request;
    }

    void go_on(const std::atomic<bool>* cancel) {
        render::RenderMonitor monitor;
        monitor.cancel = cancel;
        rays_ += renderer_.render_into(frame_, settings_, isa_, renderer_.visibility().tracer(), monitor)
                     .primary_rays;
    }

    Frame& frame() { return frame_; }
    std::uint64_t rays() const { return rays_; }

private:
    RenderSettings settings_;
    base::Isa isa_;
    render_cpu::Renderer renderer_;
    Frame frame_;
    std::uint64_t rays_ = 0;
};

/// Stores the frame in a file, as a program that ends does, and reads it as the next program does.
Frame stored_and_read(const Frame& frame, const scene::Scene& scene, const RenderSettings& settings) {
    const base::TemporaryFolder folder;
    const std::filesystem::path path = folder / "state";
    std::vector<std::size_t> finished;
    for (std::size_t i = 0; i < frame.tiles.size(); ++i)
        if (frame.is_finished[i] != 0) finished.push_back(i);
    save_checkpoint(path, {}, frame, finished, *frame.begun);
    Frame result = render::make_frame(scene, settings);
    load_checkpoint(path, {}, result);
    return result;
}

void expect_same(const Frame& frame, const Frame& whole) {
    EXPECT_EQ(frame.image.pixels, whole.image.pixels);
    EXPECT_EQ(frame.rays, whole.rays);
    ASSERT_EQ(frame.layers.size(), whole.layers.size());
    for (std::size_t i = 0; i < frame.layers.size(); ++i)
        EXPECT_EQ(frame.layers[i].data, whole.layers[i].data) << whole.layers[i].name;
}

/// Pixels with camera rays are there, others are black.
void expect_pixels_with_rays(const Frame& frame) {
    for (std::size_t i = 0; i < frame.rays.size(); ++i) {
        const float* const pixel = frame.image.pixels.data() + 3 * i;
        EXPECT_TRUE(frame.rays[i] > 0 || (pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 0)) << i;
        for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isfinite(pixel[k])) << i;
    }
    for (const image::Layer& layer : frame.layers)
        for (const float value : layer.data) EXPECT_TRUE(std::isfinite(value)) << layer.name;
}

TEST(Stop, RenderingsThatAreStoppedOftenKeepTheirBitsAndLoseNoWork) {
    const scene::Scene scene = make_box_scene(kSize);
    const std::vector<std::vector<LayerKind>> layers = {
        {},
        {LayerKind::albedo, LayerKind::depth, LayerKind::diffuse, LayerKind::variance},
        {LayerKind::lights, LayerKind::variance}};
    for (const base::Isa isa : base::kAllIsas) {
        if (!is_supported(isa)) continue;
        for (const std::vector<LayerKind>& wanted : layers) {
            RenderSettings settings;
            settings.samples = 1500;
            settings.layers = wanted;
            Runs whole(scene, settings, isa);
            whole.go_on(nullptr);

            Runs stopped(scene, settings, isa);
            std::size_t begun_tiles = 0;
            double finished = 0;
            for (int i = 0; finished < 1 && i < 1000; ++i) {
                stopped.go_on_for(Seconds(0.02));
                expect_pixels_with_rays(stopped.frame());
                begun_tiles += stopped.frame().begun->size();
                stopped.frame() = stored_and_read(stopped.frame(), scene, settings);
                finished = std::max(finished, finished_fraction(stopped.frame()));
                // Pixels of tiles that were begun come back with the next run.
                if (finished < 1 && i % 4 == 3) stopped.go_on_for(Seconds(0));
            }
            EXPECT_EQ(finished_fraction(stopped.frame()), 1);
            EXPECT_GT(begun_tiles, 3u);
            // On a busy machine, a thread may wait so long within a ray that the ray is given up and traced again.
            EXPECT_GE(stopped.rays(), whole.rays());
            EXPECT_LE(static_cast<double>(stopped.rays()), 1.02 * static_cast<double>(whole.rays()));
            expect_same(stopped.frame(), whole.frame());
        }
    }
}

TEST(Stop, SamplesOfPixelsAreThoseOfTheirCameraRays) {
    const scene::Scene scene = make_box_scene(kSize);
    RenderSettings settings;
    settings.samples = 1 << 16;
    settings.camera_rays = 1 << 14;
    Runs runs(scene, settings, base::choose_isa());
    runs.go_on_for(Seconds(0.2));
    const double finished = finished_fraction(runs.frame());
    EXPECT_GT(finished, 0);
    ASSERT_LT(finished, 1);
    double rays = 0;
    for (const float count : runs.frame().rays) rays += count;
    // The rays of pixels beside the tile do not count.
    EXPECT_GE(static_cast<double>(runs.rays()), rays);
    EXPECT_DOUBLE_EQ(finished, rays / (settings.camera_rays.value() * double{kSize} * kSize));
    const image::LayeredImage image = to_layered_image(Frame(runs.frame()), scene.film, settings, {});
    const image::Layer* const samples = find_layer(image, "samples");
    ASSERT_NE(samples, nullptr);
    for (std::size_t i = 0; i < samples->data.size(); ++i)
        EXPECT_EQ(samples->data[i], 4 * runs.frame().rays[i]);
}

/// As many lights as it takes to keep any machine busy.
scene::Scene make_scene_of_many_lights(int size) {
    scene::Scene scene = make_box_scene(size);
    for (int i = 0; i < 400; ++i) {
        const float height = 0.9f + 0.0001f * static_cast<float>(i);
        add_polygon_light(
            scene,
            {Float3{0.4f, 0.4f, height}, {0.4f, 0.6f, height}, {0.6f, 0.6f, height}, {0.6f, 0.4f, height}},
            {1, 1, 1}, true, 0);
    }
    return scene;
}

/// Settings for which one camera ray of a packet of pixels takes many seconds.
std::vector<RenderSettings> long_camera_rays() {
    RenderSettings points;
    points.samples = render::kMaxSamples;
    points.camera_rays = 1;
    points.pixel_position = render::PixelPosition::center;
    RenderSettings pairs = points;
    pairs.strategies = render::Strategies::diffuse_ltc;
    RenderSettings lines = points;
    lines.light_samples = render::LightSamples::lines;
    lines.samples = 1;
    lines.lines.count = render::kMaxLines;
    RenderSettings independent_lines = lines;
    independent_lines.lines.orientation = render::LineOrientation::independent;
    return {points, pairs, lines, independent_lines};
}

TEST(Stop, TakesLessThanASecondWithinCameraRays) {
    const scene::Scene scene = make_scene_of_many_lights(kSize);
    for (const RenderSettings& settings : long_camera_rays()) {
        for (const bool has_layers : {false, true}) {
            RenderSettings all = settings;
            if (has_layers) all.layers = {LayerKind::diffuse};
            Runs runs(scene, all, base::choose_isa());
            EXPECT_LT(runs.go_on_for(Seconds(0.3)).count(), 1);
            expect_pixels_with_rays(runs.frame());
            EXPECT_LT(finished_fraction(runs.frame()), 1);
        }
    }
}

TEST(Stop, TakesLessThanASecondWithVeryManyCameraRays) {
    const scene::Scene scene = make_box_scene(kSize);
    RenderSettings settings;
    settings.samples = render::kMaxSamples;
    Runs runs(scene, settings, base::choose_isa());
    for (int i = 0; i < 3; ++i) {
        const double before = finished_fraction(runs.frame());
        EXPECT_LT(runs.go_on_for(Seconds(0.1)).count(), 1);
        EXPECT_GT(finished_fraction(runs.frame()), before);
    }
}

/// The sums of lights, too, return to what they were before a camera ray that is given up.
TEST(Stop, LayersOfLightsGetOnWhereCameraRaysAreSlow) {
    constexpr int kPixels = 4; // of a row: one packet of pixels, or four
    const scene::Scene scene = make_scene_of_many_lights(kPixels);
    RenderSettings settings;
    settings.layers = {LayerKind::lights};
    settings.camera_rays = 16;
    settings.samples = 16;
    const auto seconds_per_ray = [&] {
        RenderSettings one = settings;
        one.camera_rays = 1;
        one.samples /= 16;
        Runs runs(scene, one, base::choose_isa());
        const Clock::time_point begin = Clock::now();
        runs.go_on(nullptr);
        return Seconds(Clock::now() - begin).count();
    };
    double seconds = seconds_per_ray();
    while (seconds < 0.5 && settings.samples < render::kMaxSamples) {
        settings.samples *= 2;
        seconds = seconds_per_ray();
    }
    Runs runs(scene, settings, base::choose_isa());
    for (int i = 0; i < 3; ++i) {
        const double before = finished_fraction(runs.frame());
        runs.go_on_for(Seconds(std::max(1.5, 3 * seconds))); // other processes may slow this one down
        EXPECT_GT(finished_fraction(runs.frame()), before);
    }
}

TEST(Stop, WithoutANextRunNothingIsKeptForIt) {
    const scene::Scene scene = make_box_scene(kSize);
    RenderSettings settings;
    settings.samples = render::kMaxSamples;
    Runs runs(scene, settings, base::choose_isa());
    runs.frame().begun.reset();
    runs.go_on_for(Seconds(0.1));
    EXPECT_FALSE(runs.frame().begun);
    EXPECT_GT(finished_fraction(runs.frame()), 0);
    expect_pixels_with_rays(runs.frame());
}

TEST(Stop, BegunTilesOfAnotherSizeAreRefused) {
    const scene::Scene scene = make_box_scene(kSize);
    for (const std::size_t size : {0, 1, 4096}) {
        Runs runs(scene, {}, base::choose_isa());
        (*runs.frame().begun)[1].resize(size);
        EXPECT_THROW(runs.go_on(nullptr), std::runtime_error) << size;
    }
}

} // namespace
} // namespace nusselt::render_test
