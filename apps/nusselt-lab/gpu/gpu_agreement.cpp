#include "apps/common/print_message.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_device.h"
#include "apps/nusselt-lab/bench/bench_output.h"
#include "apps/nusselt-lab/gpu/gpu.h"

#include "lab/errors/image_agreement.h"
#include "lab/timing/llvmpipe_threads.h"
#include "render_vulkan/unsupported.h"
#include "scene/import/importers.h"
#include "scene/input/message.h"

#include <fmt/core.h>

#include <cstdio>
#include <memory>

namespace nusselt::app {

namespace {

using render_vulkan::ShadowRays;

struct Options {
    std::vector<std::filesystem::path> scenes;
    std::filesystem::path scene_folder = "scenes";
    std::optional<std::string> resolution = "64x48";
    std::optional<std::string> device, json;
};

void print(const std::string& scene, const lab::ImageAgreement& row) {
    fmt::print("{:<16}{:<12}{:<30}{:<14}{:>10.2f} %  {}\n", scene, name_of(row.shadow_rays),
               name_of(row.settings.technique), name_of(row.settings.strategies), 100 * row.share,
               row.passes() ? "" : "FAILED");
    std::fflush(stdout);
}

int run(const Options& options) {
    check_json_option(options.json, options.scenes);
    const gpu::Device device({.choice = options.device});
    std::vector<ShadowRays> ways{ShadowRays::bvh};
    if (device.features().ray_queries) ways.push_back(ShadowRays::query);
    const auto settings = lab::compared_settings();
    lab::ResultTable images = {"images",
                               {{"scene"},
                                {"shadow_ray_tracing"},
                                {"technique"},
                                {"strategies"},
                                {"differing_share"},
                                {"rejected_samples"},
                                {"passes"}}};
    lab::ResultTable left_out = {"left_out", {{"scene"}, {"technique"}, {"strategies"}, {"reason"}}};
    lab::ResultTable failures = {"failures", {{"scene"}, {"message"}}};
    bool passes = true;
    for (const auto& path : options.scenes.empty() ? shipped_scenes(options.scene_folder) : options.scenes) {
        const std::string name = path.stem().string();
        try {
            scene::Scene scene = scene::load_scene(path);
            apply_resolution(options.resolution, scene);
            std::vector<render::RenderSettings> supported;
            for (const render::RenderSettings& one : settings) {
                const auto reason = render_vulkan::why_unsupported(scene, one);
                if (!reason) {
                    supported.push_back(one);
                    continue;
                }
                left_out.rows.push_back({name, std::string(name_of(one.technique)),
                                         std::string(name_of(one.strategies)), *reason});
                print_message("{}: left out: {}\n", name, *reason);
            }
            for (const lab::ImageAgreement& row : lab::compare_with_cpu(device, scene, ways, supported)) {
                if (options.json != "-") print(name, row);
                passes &= row.passes();
                images.rows.push_back({name, std::string(name_of(row.shadow_rays)),
                                       std::string(name_of(row.settings.technique)),
                                       std::string(name_of(row.settings.strategies)), row.share,
                                       row.rejected_samples, row.passes()});
            }
        } catch (const std::runtime_error& error) {
            // The other scenes are compared all the same.
            passes = false;
            failures.rows.push_back({name, error.what()});
            print_message("nusselt-lab: error: {}\n", scene::message_line(error.what()));
        }
    }
    lab::Results results = {"agreement",
                            device_settings(device.description(), device.pass_clock(),
                                            lab::llvmpipe_threads(device.description())),
                            {std::move(images), std::move(left_out), std::move(failures)}};
    results.settings.emplace_back("ray_queries", device.features().ray_queries);
    results.settings.emplace_back("largest_share", lab::kLargestDifferingShare);
    write_results(options.json, results, [&] {
        fmt::print("{}\n", passes ? "All images agree." : "Some images do not agree, or could not be made.");
    });
    return passes ? 0 : 1;
}

} // namespace

void setup_gpu_agreement(CLI::App& gpu, int& exit_code) {
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        gpu.add_subcommand("agreement", "Images of a device and of the CPU with the same random numbers. "
                                        "Prints the share of pixels that differ, "
                                        "for each technique and each way to trace shadow rays; exits with 1 "
                                        "if it is 3 % or more. Leaves out what GPUs do not support, "
                                        "and says so. Only pixels along "
                                        "edges may differ, of which there are more in small images.");
    add_scenes_options(*command, options->scenes, options->scene_folder);
    add_resolution_option(*command, options->resolution);
    command->get_option("--resolution")->default_str(*options->resolution);
    add_device_option(*command, options->device);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

} // namespace nusselt::app
