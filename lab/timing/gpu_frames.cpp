#include "lab/timing/gpu_frames.h"

#include "proof/median.h"
#include "render_vulkan/accumulator.h"
#include "render_vulkan/frame_records.h"
#include "scene/model/vector_math.h"
#include "scene/rig/rig.h"

#include <cassert>
#include <cmath>
#include <deque>
#include <functional>
#include <utility>

namespace nusselt::lab {

namespace {

using render::Mis;
using render::Strategies;
using render::Technique;

constexpr int kSamples = 2;

/// A frame in progress, with its pixels.
struct Running {
    explicit Running(const GpuFrame& frame)
        : image(*frame.scene, frame.settings),
          record(render_vulkan::FrameRecords(frame.scene->film(), frame.settings).make(0)) {
        image.compile();
    }

    render_vulkan::Accumulator image;
    interface::FrameRecord record;
    GpuFrameTimes times;
};

render::RenderSettings settings_of(Technique technique, Strategies strategies, Mis mis) {
    render::RenderSettings settings;
    settings.technique = technique;
    settings.strategies = strategies;
    settings.mis = mis;
    settings.samples = kSamples;
    settings.camera_rays = 1;
    return settings;
}

/// \param of of two numbers of the same round
template <class Function>
double median_of_rounds(const std::vector<double>& times, const std::vector<double>& others, Function of) {
    assert(!times.empty() && times.size() == others.size());
    std::vector<double> values;
    for (std::size_t i = 0; i < times.size(); ++i) values.push_back(of(times[i], others[i]));
    return proof::median(std::move(values));
}

double median_ratio(const std::vector<double>& times, const std::vector<double>& others) {
    return median_of_rounds(times, others, std::divides());
}

/// Removes all lights but one, which gets another shape.
scene::Scene with_only_light(const scene::Scene& scene, std::uint32_t emitter, scene::Lights shape) {
    scene::Rig rig;
    for (std::size_t i = 0; i < scene.emitters.size(); ++i) {
        scene::RigLight& light =
            rig.lights.emplace_back(scene::RigLight{"light in place of a tube", scene::Selector(i), {}});
        light.changes.remove = i != emitter;
    }
    scene::LightChanges& changes = rig.lights[emitter].changes;
    if (!std::as_const(shape).of<scene::PolygonLight>().empty()) changes.two_sided = true;
    changes.shape = std::move(shape);
    scene::Scene changed = scene;
    apply_rig(rig, changed);
    return changed;
}

/// A quadrilateral in place of a tube, with the same length and width.
scene::PolygonLight quad_in_place(const scene::LineLight& tube) {
    const scene::Double3 begin = scene::to_double(tube.start), end = scene::to_double(tube.end);
    const scene::Double3 axis = normalized(end - begin);
    const bool is_upright = std::fabs(axis.y) > 0.9;
    const scene::Double3 front = is_upright ? scene::Double3{1, 0, 0} : scene::Double3{0, 1, 0};
    const scene::Double3 half = static_cast<double>(tube.radius) * normalized(cross(axis, front));
    scene::PolygonLight quad;
    for (const scene::Double3& corner : {begin - half, end - half, end + half, begin + half})
        quad.vertices.push_back(scene::to_float(corner));
    return quad;
}

} // namespace

std::vector<double> GpuFrameTimes::whole() const {
    std::vector<double> sums;
    for (std::size_t i = 0; i < shading.size(); ++i) sums.push_back(visibility[i] + shading[i]);
    return sums;
}

std::vector<GpuFrameTimes> time_gpu_frames(std::span<const GpuFrame> frames, const GpuFrameRounds& rounds) {
    std::deque<Running> all;
    for (const GpuFrame& frame : frames) all.emplace_back(frame);
    for (int round = -rounds.warm_up; round < rounds.repetitions; ++round)
        for (Running& running : all) {
            const render_vulkan::FrameTimes times = running.image.add(running.record);
            if (round < 0) continue;
            running.times.visibility.push_back(times.visibility);
            running.times.shading.push_back(times.shading);
        }
    std::vector<GpuFrameTimes> results;
    for (Running& running : all) {
        running.times.shadow_rays = running.image.work().shadow_rays / running.image.frames();
        results.push_back(std::move(running.times));
    }
    return results;
}

GpuFrameRatio ratio_of(const GpuFrameTimes& times, const GpuFrameTimes& others) {
    GpuFrameRatio ratio{
        median_ratio(times.whole(), others.whole()), median_ratio(times.shading, others.shading), {}};
    if (times.shadow_rays > 0 && others.shadow_rays > 0)
        ratio.shadow_rays = static_cast<double>(times.shadow_rays) / static_cast<double>(others.shadow_rays);
    return ratio;
}

double additional_time(const GpuFrameTimes& times, const GpuFrameTimes& others) {
    return median_of_rounds(times.whole(), others.whole(), std::minus());
}

std::vector<render::RenderSettings> timed_settings() {
    std::vector<render::RenderSettings> all;
    for (const auto& [strategies, mis] : {std::pair(Strategies::diffuse, Mis::clamped_optimal),
                                          std::pair(Strategies::diffuse_ltc, Mis::clamped_optimal),
                                          std::pair(Strategies::diffuse_ggx, Mis::balance)})
        for (const Technique technique : render::kTechniques)
            if (allows(technique, strategies)) all.push_back(settings_of(technique, strategies, mis));
    all.push_back(sample_pair().ours);
    return all;
}

SettingsPair strategies_pair() {
    return {settings_of(Technique::projected_solid_angle, Strategies::diffuse_ltc, Mis::clamped_optimal),
            settings_of(Technique::solid_angle, Strategies::diffuse_ggx, Mis::balance)};
}

SettingsPair sample_pair() {
    const render::RenderSettings baseline =
        settings_of(Technique::projected_solid_angle, Strategies::diffuse, Mis::clamped_optimal);
    SettingsPair pair{baseline, baseline};
    ++pair.ours.samples;
    return pair;
}

bool is_same(const render::RenderSettings& a, const render::RenderSettings& b) {
    return a.technique == b.technique && a.strategies == b.strategies && a.mis == b.mis &&
           a.samples == b.samples;
}

std::optional<LineAndQuad> line_and_quad(const scene::Scene& scene) {
    if (scene.lights.of<scene::LineLight>().empty()) return std::nullopt;
    const scene::LineLight& tube = scene.lights.of<scene::LineLight>().front();
    scene::LineLight line = tube;
    line.model = scene::TubeModel::linear;
    return LineAndQuad{with_only_light(scene, tube.emitter, only(line)),
                       with_only_light(scene, tube.emitter, only(quad_in_place(tube)))};
}

} // namespace nusselt::lab
