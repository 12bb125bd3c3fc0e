#include "apps/common/interrupt.h"
#include "apps/common/progress.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt/scene/lights.h"
#include "render_backend.h"
#include "render_files.h"

#include "gpu/device.h"
#include "image/io.h"
#include "render/metadata.h"
#include "render_vulkan/renderer.h"

#include <fmt/core.h>

#include <optional>
#include <stdexcept>
#include <string>

namespace nusselt::app {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Why --backend auto takes the CPU; nothing if it does not. A device that was asked for by name is taken in any case.
std::optional<std::string> why_cpu(const RenderOptions& options, const render::RenderSettings& settings) {
    if (options.checkpoint || options.display_server || options.isa)
        return "--checkpoint, --display-server and --isa need it";
    try {
        render_vulkan::check_supported(settings);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    if (options.device) return std::nullopt;
    try {
        const gpu::DeviceDescription device = gpu::chosen_device();
        if (device.is_software) return "the only device is " + device.name + ", a software one";
    } catch (const gpu::Error& error) {
        return error.what();
    }
    return std::nullopt;
}

nlohmann::ordered_json gpu_report(const RenderOptions& options, const render::RenderSettings& settings,
                                  const scene::Scene& scene, const render_vulkan::VulkanRenderer& renderer,
                                  const render_vulkan::RenderStatistics& statistics, const Times& times) {
    const gpu::DeviceDescription& device = renderer.device().description();
    nlohmann::ordered_json json = settings_json(options, settings, scene);
    json.update({{"backend", "vulkan"},
                 {"device", device.name},
                 {"driver", device.driver},
                 {"shadow_ray_tracing", name_of(renderer.shadow_rays())},
                 {"seconds",
                  {{"load", times.load},
                   {"upload", statistics.build_seconds},
                   {"compile", statistics.compile_seconds},
                   {"render", statistics.render_seconds},
                   {"write", times.write},
                   {"total", times.total}}},
                 {"device_seconds",
                  {{"visibility", statistics.visibility_seconds}, {"shading", statistics.shading_seconds}}},
                 {"rays", {{"primary", statistics.primary_rays}, {"shadow", statistics.work.shadow_rays}}},
                 {"rejected_samples", statistics.work.rejected_samples}});
    return json;
}

} // namespace

bool renders_on_gpu(const RenderOptions& options, const render::RenderSettings& settings) {
    if (options.backend == "cpu") return false;
    if (options.backend == "auto") {
        if (const auto reason = why_cpu(options, settings)) {
            if (!options.quiet) fmt::print(stderr, "rendering on the CPU: {}\n", *reason);
            return false;
        }
    }
    if (const auto reason = gpu::why_no_device({.choice = options.device})) throw gpu::NoDevice(*reason);
    render_vulkan::check_supported(settings);
    return true;
}

int render_on_gpu(const RenderOptions& options, const render::RenderSettings& settings,
                  const scene::Scene& scene, Times times, std::chrono::steady_clock::time_point begin) {
    const gpu::Device device({.choice = options.device});
    if (!options.quiet) fmt::print(stderr, "rendering on {}\n", device.description().name);
    const auto shadow_rays = options.shadow_rays ? from_name(render_vulkan::kShadowRays, *options.shadow_rays)
                                                 : render_vulkan::default_shadow_rays(device);
    render_vulkan::VulkanRenderer renderer(device, scene, shadow_rays);
    Progress progress;
    render_vulkan::RenderMonitor monitor;
    monitor.cancel = &interrupted;
    if (!options.quiet) monitor.progress = [&](double fraction) { progress.update(fraction); };
    const render_vulkan::RenderResult result = renderer.render(settings, monitor);
    progress.finish();
    if (result.finished_fraction == 0) {
        if (!options.quiet) fmt::print(stderr, "stopped before the first frame; no image is written\n");
        return kInterruptedExitCode;
    }

    const auto write_begin = Clock::now();
    image::Metadata metadata = render::make_metadata(scene, settings);
    if (!options.rigs.empty()) metadata["light_rigs"] = rig_names(options.rigs);
    metadata["device"] = device.description().name;
    metadata["scene"] = options.scene.filename().string();
    metadata["render_seconds"] = image::metadata_text(result.statistics.render_seconds);
    metadata["finished_fraction"] = image::metadata_text(result.finished_fraction);
    for (const std::filesystem::path& path : output_paths(options, scene.film))
        image::write_image(path, result.image, metadata, options.exposure);
    print_outputs(options, scene.film);
    times.write = seconds_since(write_begin);
    times.total = seconds_since(begin);
    if (options.json)
        write_report(*options.json, gpu_report(options, settings, scene, renderer, result.statistics, times));
    if (result.finished_fraction == 1) return 0;
    if (!options.quiet)
        fmt::print(stderr, "stopped after {:.1f} % of the camera rays\n", 100 * result.finished_fraction);
    return kInterruptedExitCode;
}

} // namespace nusselt::app
