#include "view.h"
#include "apps/common/help.h"
#include "apps/common/print_message.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt/render/render_backend.h"
#include "apps/nusselt/render/render_files.h"
#include "apps/nusselt/render/render_settings.h"
#include "apps/nusselt/scene/camera.h"
#include "apps/nusselt/scene/lights.h"

#include "base/file_checks.h"
#include "gpu/device.h"
#include "render_vulkan/shadows/shadow_scene.h"
#include "render_vulkan/unsupported.h"
#include "scene/rig/camera_file.h"
#include "viewer/window/run_viewer.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

namespace nusselt::app {

void setup_view(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<ViewOptions>();
    options->render.backend = "vulkan";
    CLI::App* const command =
        app.add_subcommand("view", "Show a scene in a window, rendered by a GPU. Fly through it, change "
                                   "techniques and lights, and compare images "
                                   "with each other and with a reference (docs/viewer.md).");
    RenderOptions& render = options->render;
    add_scene_argument(*command, render.scene);
    command->add_option("--exposure", render.exposure, "Brighten the displayed image by this many stops")
        ->check(number(-viewer::kLargestExposure, viewer::kLargestExposure))
        ->group(kOutputGroup);
    command
        ->add_option(
            "--script", options->script,
            "File with commands to run one after the other, such as `frames 16` and `screenshot a.png`; "
            "`quit` closes the window")
        ->type_name("FILE")
        ->default_str(kNone)
        ->group(kOutputGroup);
    command->add_flag("-q,--quiet", render.quiet, "Print only errors: no warnings")->group(kOutputGroup);
    command->add_option("--spp", render.samples, "Samples per pixel, light and technique in a frame")
        ->transform(to_whole_number(1, viewer::kMostFrameSamples))
        ->default_str("1")
        ->group(kSamplingGroup);
    add_sampling_options(*command, render);
    add_rigs_option(*command, render.rigs);
    add_camera_option(*command, render.camera);
    add_resolution_option(*command, render.resolution);
    add_device_options(*command, render);
    command->callback([options, &exit_code] {
        check_combination(options->render);
        exit_code = run_view(*options);
    });
}

int run_view(const ViewOptions& options) {
    const RenderOptions& render = options.render;
    const render::RenderSettings settings = make_settings(render);
    base::check_exist(input_paths(render));
    const gpu::Device device({.choice = render.device}); // before the time that loading takes
    scene::Scene scene = load_scene(render.scene, render.rigs);
    if (render.camera) apply_camera(scene::read_camera_file(*render.camera), scene);
    apply_resolution(render.resolution, scene);
    if (!render.quiet) {
        for (const std::string& warning : scene.warnings) print_message("warning: {}\n", warning);
        for (const std::string& warning : render_vulkan::sampling_warnings(scene, settings))
            print_message("warning: {}\n", warning);
    }

    const auto shadow_rays = render.shadow_rays ? from_name(render_vulkan::kShadowRays, *render.shadow_rays)
                                                : render_vulkan::default_shadow_rays(device);
    std::vector<std::filesystem::path> inputs = scene.files;
    const std::vector<std::filesystem::path> named = input_paths(render);
    inputs.insert(inputs.end(), named.begin(), named.end());
    if (options.script) inputs.push_back(*options.script);
    viewer::Viewer viewer(device, scene, shadow_rays, settings,
                          {render.scene, render.rigs, render.device, std::move(inputs)});
    viewer.state.exposure = render.exposure;
    run_viewer(viewer, options.script);
    return 0;
}

} // namespace nusselt::app
