#pragma once
/// The contract of every backend. The tests of each backend run these checks.

#include "render/backend.h"
#include "render/metadata.h"

#include <gtest/gtest.h>

#include <set>

namespace nusselt::render_test {

/// \param scene with some light on all of its pixels
/// \param settings that the backend supports
inline void expect_backend_contract(const render::Backend& backend, const scene::Scene& scene,
                                    const render::RenderSettings& settings) {
    ASSERT_EQ(backend.why_unsupported(settings), std::nullopt);
    EXPECT_FALSE(backend.name().empty());
    for (const auto& [key, value] : backend.metadata()) {
        EXPECT_FALSE(value.empty()) << key;
        EXPECT_EQ(render::make_metadata(scene, settings).count(key), 0u) << key << " is the frame's";
        EXPECT_EQ(render::make_metadata(scene, settings, backend).at(key), value);
    }
    for (const auto& [key, value] : backend.properties()) EXPECT_FALSE(value.empty()) << key;

    const std::unique_ptr<render::PreparedScene> prepared = backend.prepare(scene);
    render::Frame frame = render::make_frame(scene, settings);
    ASSERT_GT(frame.tiles.size(), 1u);
    finish_tile(frame, 0);
    std::set<std::size_t> finished;
    double progress = 0;
    render::RenderMonitor monitor;
    monitor.tile_finished = [&](std::size_t tile) { EXPECT_TRUE(finished.insert(tile).second) << tile; };
    monitor.progress = [&](double fraction) {
        EXPECT_GT(fraction, progress);
        progress = fraction;
    };
    const render::RenderStatistics statistics = prepared->render_into(frame, settings, monitor);
    EXPECT_EQ(progress, 1);
    EXPECT_EQ(finished.size(), frame.tiles.size() - 1);
    EXPECT_EQ(finished_fraction(frame), 1);
    EXPECT_GT(statistics.primary_rays, 0u);
    EXPECT_GT(statistics.shadow_rays, 0u);
    EXPECT_EQ(statistics.rejected_samples, 0u);
    const render::TimeReport times = backend.times(statistics);
    EXPECT_FALSE(times.work_name.empty());
    double work = 0;
    for (const auto& [name, seconds] : times.work) work += seconds;
    EXPECT_GT(work, 0);

    // Tiles that were finished before are left alone, and all others are as in the whole image.
    const render::RenderResult whole = render::render(backend, scene, settings);
    EXPECT_EQ(whole.finished_fraction, 1);
    const render::Tile& first = frame.tiles[0];
    for (int y = frame.bounds.y_begin; y < frame.bounds.y_end; ++y)
        for (int x = frame.bounds.x_begin; x < frame.bounds.x_end; ++x) {
            const auto pixel = static_cast<std::size_t>(y - frame.bounds.y_begin) *
                                   static_cast<std::size_t>(frame.image.width) +
                               static_cast<std::size_t>(x - frame.bounds.x_begin);
            const bool was_finished = x < first.x_end && y < first.y_end;
            const float expected = was_finished ? 0 : whole.image.pixels[3 * pixel];
            ASSERT_EQ(frame.image.pixels[3 * pixel], expected) << x << ", " << y;
            ASSERT_GT(whole.image.pixels[3 * pixel], 0) << x << ", " << y;
        }

    // No work starts once a rendering is cancelled.
    const std::atomic<bool> cancel = true;
    render::Frame none = render::make_frame(scene, settings);
    prepared->render_into(none, settings,
                          {.started = {}, .progress = {}, .tile_finished = {}, .cancel = &cancel});
    EXPECT_EQ(finished_fraction(none), 0);
    for (const float value : none.image.pixels) ASSERT_EQ(value, 0);
}

} // namespace nusselt::render_test
