#include "bench_gpu_frames.h"
#include "apps/common/help.h"
#include "apps/common/print_message.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_device.h"
#include "apps/nusselt-lab/bench/bench_output.h"
#include "bench_gpu_frames_report.h"

#include "lab/timing/llvmpipe_threads.h"
#include "render_vulkan/unsupported.h"
#include "scene/import/importers.h"
#include "scene/input/message.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <memory>
#include <span>
#include <stdexcept>

namespace nusselt::app {

namespace {

using lab::GpuFrame;
using lab::GpuFrameTimes;
using render_vulkan::DeviceScene;
using render_vulkan::ShadowRays;

/// Fills a table, scene by scene.
class Measurement {
public:
    Measurement(const gpu::Device& device, const BenchGpuFramesOptions& options, GpuFrameTable& table)
        : device_(device), table_(table) {
        for (const std::string& name : options.shadow_rays)
            ways_.push_back(from_name(render_vulkan::kShadowRays, name));
        if (ways_.empty()) ways_ = {render_vulkan::default_shadow_rays(device), ShadowRays::none};
        for (const render::RenderSettings& settings : lab::timed_settings()) {
            const std::string name(name_of(settings.technique));
            if (options.techniques.empty() || std::find(options.techniques.begin(), options.techniques.end(),
                                                        name) != options.techniques.end())
                chosen_settings_.push_back(settings);
        }
    }

    void add(const std::string& name, const scene::Scene& scene) {
        print_message("{}\n", name);
        settings_.clear();
        for (const render::RenderSettings& settings : chosen_settings_) {
            if (const auto reason = render_vulkan::why_unsupported(scene, settings))
                print_message("not measured: {}\n", *reason);
            else
                settings_.push_back(settings);
        }
        add_techniques(name, scene);
        add_line_and_quad(name, scene);
    }

private:
    /// All ways to trace in the same rounds.
    void add_techniques(const std::string& name, const scene::Scene& scene) {
        std::deque<DeviceScene> scenes;
        std::vector<GpuFrame> frames;
        for (const ShadowRays way : ways_) {
            const DeviceScene& device_scene = scenes.emplace_back(device_, scene, way);
            for (const render::RenderSettings& settings : settings_)
                frames.push_back({&device_scene, settings});
        }
        const std::vector<GpuFrameTimes> times = lab::time_gpu_frames(frames, table_.rounds);
        for (std::size_t i = 0; i < frames.size(); ++i) add_row(name, frames[i], times[i]);
        for (std::size_t i = 0; i < ways_.size(); ++i) {
            const auto times_of_way = std::span(times).subspan(i * settings_.size(), settings_.size());
            compare_strategies(name, ways_[i], times_of_way);
            compare_samples(name, scene, ways_[i], times_of_way);
        }
    }

    /// \param times one for each of the settings
    void compare_strategies(const std::string& name, ShadowRays way, std::span<const GpuFrameTimes> times) {
        const lab::SettingsPair pair = lab::strategies_pair();
        const GpuFrameTimes* const ours = find(pair.ours, times);
        const GpuFrameTimes* const baseline = find(pair.baseline, times);
        if (ours == nullptr || baseline == nullptr) return;
        table_.comparisons.push_back({name, way, text_of(pair.ours), text_of(pair.baseline),
                                      ratio_of(*ours, *baseline), lab::kPublishedStrategiesRatio});
    }

    /// \param times one for each of the settings
    void compare_samples(const std::string& name, const scene::Scene& scene, ShadowRays way,
                         std::span<const GpuFrameTimes> times) {
        const lab::SettingsPair pair = lab::sample_pair();
        const GpuFrameTimes* const more = find(pair.ours, times);
        const GpuFrameTimes* const fewer = find(pair.baseline, times);
        if (more == nullptr || fewer == nullptr) return;
        table_.sample_times.push_back({name, scene.film.width, scene.film.height, scene.lights.size(), way,
                                       text_of(pair.baseline), additional_time(*more, *fewer)});
    }

    /// Both frames are shaded without samples, hence without shadow rays.
    void add_line_and_quad(const std::string& name, const scene::Scene& scene) {
        const auto analytic = std::find_if(settings_.begin(), settings_.end(), [](const auto& settings) {
            return settings.technique == render::Technique::ltc_analytic;
        });
        const auto both = lab::line_and_quad(scene);
        if (analytic == settings_.end() || !both) return;
        const DeviceScene line(device_, both->line, ShadowRays::none);
        const DeviceScene quad(device_, both->quad, ShadowRays::none);
        const GpuFrame frames[] = {{&line, *analytic}, {&quad, *analytic}};
        const std::vector<GpuFrameTimes> times = lab::time_gpu_frames(frames, table_.rounds);
        add_row(name + ", a line as light", frames[0], times[0]);
        add_row(name + ", a quad as light", frames[1], times[1]);
        table_.comparisons.push_back({name, ShadowRays::none, "ltc_analytic, a line", "the same, a quad",
                                      ratio_of(times[0], times[1]), lab::kPublishedLineRatio});
    }

    void add_row(const std::string& name, const GpuFrame& frame, const GpuFrameTimes& times) {
        const scene::Film& film = frame.scene->film();
        table_.rows.push_back(
            {name, film.width, film.height, frame.scene->shadows().way(), frame.settings, times});
    }

    /// Null if these settings are not measured.
    const GpuFrameTimes* find(const render::RenderSettings& wanted,
                              std::span<const GpuFrameTimes> times) const {
        for (std::size_t i = 0; i < settings_.size(); ++i)
            if (lab::is_same(settings_[i], wanted)) return &times[i];
        return nullptr;
    }

    const gpu::Device& device_;
    GpuFrameTable& table_;
    std::vector<ShadowRays> ways_;
    std::vector<render::RenderSettings> chosen_settings_;
    std::vector<render::RenderSettings> settings_; ///< those that GPUs support for the scene
};

std::vector<std::filesystem::path> files_of(const std::filesystem::path& scene) {
    try {
        return scene::load_scene(scene).files;
    } catch (const std::runtime_error&) {
        return {scene}; // what is wrong is reported in place of measurements
    }
}

} // namespace

int run_bench_gpu_frames(const BenchGpuFramesOptions& options) {
    check_json_option(options.json, options.scenes);
    const std::vector<std::filesystem::path> scenes =
        options.scenes.empty() ? shipped_scenes(options.scene_folder) : options.scenes;
    // Before hours of measuring, for the results must not replace a file of a scene.
    if (options.json)
        for (const std::filesystem::path& path : scenes) check_json_option(options.json, files_of(path));
    const gpu::Device device({.choice = options.device});
    GpuFrameTable table;
    table.device = device.description();
    table.clock = device.pass_clock();
    table.llvmpipe_threads = lab::llvmpipe_threads(device.description());
    table.rounds = {options.frames, options.warm_up};
    Measurement measurement(device, options, table);
    for (const std::filesystem::path& path : scenes) {
        const std::string name = path.stem().string();
        try {
            scene::Scene scene = scene::load_scene(path);
            apply_resolution(options.resolution, scene);
            measurement.add(name, scene);
        } catch (const std::runtime_error& error) {
            // Keep the results of the other scenes, which took long to measure.
            table.failures.push_back({name, error.what()});
            print_message("nusselt-lab: error: {}\n", scene::message_line(error.what()));
        }
    }
    write_results(options.json, results_of(table), [&] { print_table(table); });
    return table.failures.empty() ? 0 : 1;
}

void setup_bench_gpu_frames(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchGpuFramesOptions>();
    CLI::App* command = bench.add_subcommand(
        "gpu",
        "Cost of frames on a GPU. Prints the times of the visibility pass and of the shading pass with each "
        "technique and strategy, two samples of each per pixel in one frame; the time of one more sample of "
        "each light (Peters 2021, linear lights, Sec. 5.4); ratios between the two ways of sampling "
        "materials that Peters (2021, polygonal lights, Fig. 1) compares; and where a scene has a tube, the "
        "ratio between analytic shading of a line and of a quad in its place (Heitz and Hill 2017, "
        "Sec. 1.7).");
    add_scenes_options(*command, options->scenes, options->scene_folder);
    add_resolution_option(*command, options->resolution);
    command->get_option("--resolution")->default_str(*options->resolution);
    command->add_option("--frames", options->frames, "Frames of each kind; the median is reported")
        ->transform(to_whole_number(1, 10001));
    command->add_option("--warm-up", options->warm_up, "Frames of each kind to warm up")
        ->transform(to_whole_number(0, 10000));
    command->add_option("--techniques", options->techniques, "Only these techniques")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->transform(to_one_of(names_of(render::kTechniques)))
        ->default_str("all")
        ->group(kSamplingGroup);
    command
        ->add_option(
            "--shadow-rays", options->shadow_rays,
            "Ways to trace shadow rays: query (ray queries of the driver), bvh (our own hierarchy) or none")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->transform(to_one_of(names_of(render_vulkan::kShadowRays)))
        ->default_str("query where the device supports it, else bvh; and none")
        ->group(kDeviceGroup);
    add_device_option(*command, options->device);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_gpu_frames(*options); });
}

} // namespace nusselt::app
