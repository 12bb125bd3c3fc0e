#pragma once
/// The results of `nusselt-lab bench gpu`.

#include "gpu/device.h"
#include "lab/results/results.h"
#include "lab/timing/gpu_frames.h"

#include <optional>
#include <string>
#include <vector>

namespace nusselt::app {

/// Frames of one kind.
struct GpuFrameRow {
    std::string scene;
    int width, height;
    render_vulkan::ShadowRays shadow_rays;
    render::RenderSettings settings;
    lab::GpuFrameTimes times;
};

/// Two kinds of frames of the same rounds.
struct GpuFrameComparison {
    std::string scene;
    render_vulkan::ShadowRays shadow_rays;
    std::string ours, baseline;
    lab::GpuFrameRatio ratio;
    double published; ///< the ratio of the paper
};

/// What one more sample per pixel and light costs.
struct GpuSampleTime {
    std::string scene;
    int width, height;
    std::size_t lights;
    render_vulkan::ShadowRays shadow_rays;
    std::string settings; ///< text_of()
    double seconds;       ///< for all lights of the frame

    /// The paper has a frame of 1920 x 1080 pixels with one light.
    bool is_like_the_published() const { return width == 1920 && height == 1080 && lights == 1; }
};

/// A scene that could not be measured.
struct GpuFrameFailure {
    std::string scene, message;
};

struct GpuFrameTable {
    gpu::DeviceDescription device;
    gpu::Clock clock; ///< of passes
    std::optional<std::string> llvmpipe_threads;
    lab::GpuFrameRounds rounds;
    std::vector<GpuFrameRow> rows;
    std::vector<GpuFrameComparison> comparisons;
    std::vector<GpuSampleTime> sample_times;
    std::vector<GpuFrameFailure> failures;
};

/// Technique, strategies and heuristic.
std::string text_of(const render::RenderSettings& settings);

void print_table(const GpuFrameTable& table);

lab::Results results_of(const GpuFrameTable& table);

} // namespace nusselt::app
