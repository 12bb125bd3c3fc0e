#include "render_backend.h"

#include "apps/common/help.h"
#include "apps/common/print_message.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"

#include "base/words.h"
#include "render_cpu/backend.h"
#include "render_cpu/renderer.h"
#include "render_vulkan/shadows/shadow_rays.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::app {

void add_backend_options(CLI::App& command, RenderOptions& options) {
    command
        .add_option("--backend", options.backend,
                    "Renderer: cpu; vulkan, on a GPU; or auto, on a GPU if one is available, else on the CPU")
        ->transform(to_one_of({"cpu", "vulkan", "auto"}))
        ->group(kDeviceGroup);
    add_device_options(command, options);
}

void add_device_options(CLI::App& command, RenderOptions& options) {
    command.add_option("--device", options.device, "GPU, by its index or a part of its name")
        ->type_name("DEVICE")
        ->default_str("the environment variable NUSSELT_DEVICE if set, else the fastest kind")
        ->group(kDeviceGroup);
    command
        .add_option(
            "--shadow-rays", options.shadow_rays,
            "How a GPU traces shadow rays: query (ray queries of its driver), bvh (our own hierarchy), or "
            "none, for an image without shadows")
        ->transform(to_one_of(names_of(render_vulkan::kShadowRays)))
        ->default_str("query where the device supports it in hardware, else bvh")
        ->group(kDeviceGroup);
}

namespace {

/// The name of an option and whether it is used.
using OptionUse = std::pair<std::string, bool>;

std::vector<OptionUse> options_of_cpu(const RenderOptions& options) {
    return {{"--checkpoint", options.checkpoint.has_value()},
            {"--display-server", options.display_server.has_value()},
            {"--isa", options.isa.has_value()}};
}

std::vector<OptionUse> options_of_gpu(const RenderOptions& options) {
    return {{"--device", options.device.has_value()}, {"--shadow-rays", options.shadow_rays.has_value()}};
}

/// \throws CLI::ValidationError if one of the options, which are for one backend, is used
void refuse(const std::vector<OptionUse>& options, const std::string& backend) {
    for (const auto& [name, is_used] : options)
        if (is_used) throw CLI::ValidationError(name, "supported only with --backend " + backend);
}

} // namespace

void check_backend_options(const RenderOptions& options) {
    if (options.backend == "cpu") refuse(options_of_gpu(options), "vulkan");
    if (options.backend == "vulkan") refuse(options_of_cpu(options), "cpu");
}

namespace {

/// The reason for which --backend auto renders on the CPU; nothing if it renders on a GPU.
std::optional<std::string> why_on_cpu(const RenderOptions& options, const render::RenderSettings& settings) {
    std::vector<std::string> names;
    bool is_any_used = false;
    for (const auto& [name, is_used] : options_of_cpu(options)) {
        names.push_back(name);
        is_any_used |= is_used;
    }
    if (is_any_used) return base::listing(names, "and") + " are supported only there";
    return why_not_on_gpu(options, settings);
}

bool renders_on_cpu(const RenderOptions& options, const render::RenderSettings& settings) {
    if (options.backend != "auto") return options.backend == "cpu";
    const auto reason = why_on_cpu(options, settings);
    if (reason && !options.quiet) print_message("rendering on the CPU: {}\n", *reason);
    return reason.has_value();
}

std::unique_ptr<render::Backend> make_cpu_backend(const RenderOptions& options) {
    return std::make_unique<render_cpu::CpuBackend>(
        base::choose_isa(options.isa), options.threads.value_or(render_cpu::default_thread_count()));
}

} // namespace

std::unique_ptr<render::Backend> make_backend(const RenderOptions& options,
                                              const render::RenderSettings& settings) {
    if (renders_on_cpu(options, settings)) return make_cpu_backend(options);
    std::unique_ptr<render::Backend> gpu = make_gpu_backend(options);
    if (const auto reason = gpu->why_unsupported(settings))
        throw std::invalid_argument(*reason + "; use --backend cpu");
    return gpu;
}

std::unique_ptr<render::Backend> backend_for(const scene::Scene& scene,
                                             std::unique_ptr<render::Backend> backend,
                                             const RenderOptions& options,
                                             const render::RenderSettings& settings) {
    if (const auto reason = backend->why_unsupported(scene, settings)) {
        if (options.backend != "auto") throw std::invalid_argument(*reason + "; use --backend cpu");
        if (!options.quiet) print_message("rendering on the CPU: {}\n", *reason);
        return make_cpu_backend(options);
    }
    const image::Metadata metadata = backend->metadata();
    const auto device = metadata.find("device");
    if (device != metadata.end() && !options.quiet) print_message("rendering on {}\n", device->second);
    return backend;
}

} // namespace nusselt::app
