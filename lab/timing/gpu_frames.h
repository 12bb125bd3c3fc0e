#pragma once
/// Times of frames on a GPU.

#include "render/settings.h"
#include "render_vulkan/device_scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nusselt::lab {

/// What is rendered, again and again.
struct GpuFrame {
    const render_vulkan::DeviceScene* scene;
    render::RenderSettings settings; ///< with one camera ray
};

/// What the passes took [s], a number for each repetition.
struct GpuFrameTimes {
    std::vector<double> visibility;
    std::vector<double> shading;
    std::uint64_t shadow_rays = 0; ///< of one frame; with ShadowRays::none those that were left out

    /// Both passes.
    std::vector<double> whole() const;
};

struct GpuFrameRounds {
    int repetitions = 15; ///< odd numbers give true medians
    int warm_up = 3;      ///< rounds before those
};

/// Renders frames in turn, so that a drift of the clock rate hits all alike. Shaders are compiled once, before that.
/// \throws std::invalid_argument see render_vulkan::Accumulator
/// \throws gpu::Error if memory runs out, or the device is lost
std::vector<GpuFrameTimes> time_gpu_frames(std::span<const GpuFrame> frames, const GpuFrameRounds& rounds);

/// One frame over another one of the same rounds.
struct GpuFrameRatio {
    double whole, shading;             ///< medians of the ratios of times
    std::optional<double> shadow_rays; ///< none if there are none
};

/// \param times, others of at least one repetition, both of the same number
GpuFrameRatio ratio_of(const GpuFrameTimes& times, const GpuFrameTimes& others);

/// All techniques with all strategies that are of use with two samples of each technique per pixel in one frame: of
/// projected solid angles and lobes with the clamped optimal heuristic, with visible normals by the balance heuristic.
std::vector<render::RenderSettings> timed_settings();

/// Two of timed_settings().
struct SettingsPair {
    render::RenderSettings ours, baseline;
};

/// Projected solid angles and lobes over what was usual: Fig. 1 of Peters 2021, polygonal lights. As many samples; visible
/// normals that miss the light need no shadow ray.
SettingsPair strategies_pair();
inline constexpr double kPublishedStrategiesRatio = 1.47 / 0.74;

bool is_same(const render::RenderSettings& a, const render::RenderSettings& b);

/// A scene whose only light is linear, and the same with a quad in its place.
struct LineAndQuad {
    scene::Scene line, quad;
};

/// The line is the first tube of the scene. The quad shines to both sides, up and down unless the tube is upright, and is as
/// wide as the tube, so that from there both have the same size.
/// \returns nothing if the scene has no tube
std::optional<LineAndQuad> line_and_quad(const scene::Scene& scene);
/// Heitz and Hill 2017, Sec. 1.7: the shading pass, with the analytic technique.
inline constexpr double kPublishedLineRatio = 0.42 / 0.58;

} // namespace nusselt::lab
