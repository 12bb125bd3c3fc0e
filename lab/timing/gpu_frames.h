#pragma once
/// Times of frames on a GPU.

#include "render/settings.h"
#include "render_vulkan/device_scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nusselt::lab {

/// A frame to be rendered repeatedly.
struct GpuFrame {
    const render_vulkan::DeviceScene* scene;
    render::RenderSettings settings; ///< with one camera ray
};

/// The times of the passes [s], one for each repetition.
struct GpuFrameTimes {
    std::vector<double> visibility;
    std::vector<double> shading;
    std::uint64_t shadow_rays = 0; ///< of one frame; those left out with ShadowRays::none

    /// The times of both passes together.
    std::vector<double> whole() const;
};

struct GpuFrameRounds {
    int repetitions = 15; ///< odd numbers give exact medians
    int warm_up = 3;      ///< rounds before the repetitions
};

/// Renders the frames in turn, so that a drift of the clock rate affects all alike. Compiles the shaders once, before
/// the first frame.
/// \throws std::invalid_argument see render_vulkan::Accumulator
/// \throws gpu::Error if memory runs out, or the device is lost
std::vector<GpuFrameTimes> time_gpu_frames(std::span<const GpuFrame> frames, const GpuFrameRounds& rounds);

/// Ratios of one frame to another one of the same rounds.
struct GpuFrameRatio {
    double whole, shading;             ///< medians of the ratios of times
    std::optional<double> shadow_rays; ///< none if there are none
};

/// \param times,others times of the same number of repetitions, at least one
GpuFrameRatio ratio_of(const GpuFrameTimes& times, const GpuFrameTimes& others);

/// [s], the median over the rounds of how much longer a frame takes
/// \param times,others times of the same number of repetitions, at least one
double additional_time(const GpuFrameTimes& times, const GpuFrameTimes& others);

/// All techniques and strategies that make sense with two samples of each technique per pixel and frame: projected
/// solid angles and lobes with the clamped optimal heuristic, and visible normals with the balance heuristic. Besides, the
/// longer frame of sample_pair().
std::vector<render::RenderSettings> timed_settings();

/// Two of timed_settings().
struct SettingsPair {
    render::RenderSettings ours, baseline;
};

/// Projected solid angles and lobes, compared with the techniques that were common before: Fig. 1 of Peters 2021,
/// polygonal lights. Both take as many samples, but visible normals that miss the light need no shadow ray.
SettingsPair strategies_pair();
inline constexpr double kPublishedStrategiesRatio = 1.47 / 0.74;

/// Projected solid angles with three samples per pixel, and with two: Peters 2021, linear lights, Sec. 5.4.
SettingsPair sample_pair();
/// [s], at 1920 x 1080 on a Geforce RTX 2080 Ti
inline constexpr double kPublishedSampleTime = 0.45e-3;

bool is_same(const render::RenderSettings& a, const render::RenderSettings& b);

/// A scene whose only light is linear, and the same scene with a quadrilateral in its place.
struct LineAndQuad {
    scene::Scene line, quad;
};

/// The line is the first tube of the scene. The quadrilateral is as wide as the tube and shines to both sides, up and
/// down unless the tube is upright. Seen along its normal, it thus has the size of the tube.
/// \returns nothing if the scene has no tube
std::optional<LineAndQuad> line_and_quad(const scene::Scene& scene);
/// The ratio for the shading pass with the analytic technique in Heitz and Hill 2017, Sec. 1.7.
inline constexpr double kPublishedLineRatio = 0.42 / 0.58;

} // namespace nusselt::lab
