#include "render_backend.h"

#include "apps/common/render_setup.h"

#include "render_cpu/backend.h"
#include "render_cpu/renderer.h"

#include <fmt/core.h>

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace nusselt::app {

void add_backend_options(CLI::App& command, RenderOptions& options) {
    command
        .add_option("--backend", options.backend,
                    "Renderer: cpu; vulkan, on a GPU; or auto, on a GPU if one is available, else on the CPU")
        ->check(CLI::IsMember({"cpu", "vulkan", "auto"}))
        ->capture_default_str();
    add_device_options(command, options);
}

void add_device_options(CLI::App& command, RenderOptions& options) {
    command.add_option("--device", options.device,
                       "GPU, by its index or a part of its name. Default: the environment variable\n"
                       "NUSSELT_DEVICE if set, else the fastest kind");
    command
        .add_option(
            "--shadow-rays", options.shadow_rays,
            "How a GPU traces shadow rays: query (ray queries of its driver), bvh (our own hierarchy),\n"
            "or none, for an image without shadows. Default: query where the device supports it in\n"
            "hardware, else bvh")
        ->check(CLI::IsMember({"query", "bvh", "none"}));
}

void check_backend_options(const RenderOptions& options) {
    const auto refuse = [](const std::string& option, const std::string& backend) {
        throw CLI::ValidationError(option, "supported only with --backend " + backend);
    };
    if (options.backend == "cpu")
        for (const auto& [name, is_used] : {std::pair("--device", options.device.has_value()),
                                            std::pair("--shadow-rays", options.shadow_rays.has_value())})
            if (is_used) refuse(name, "vulkan");
    if (options.backend == "vulkan")
        for (const auto& [name, is_used] : {std::pair("--checkpoint", options.checkpoint.has_value()),
                                            std::pair("--display-server", options.display_server.has_value()),
                                            std::pair("--isa", options.isa.has_value())})
            if (is_used) refuse(name, "cpu");
}

namespace {

/// The reason for which --backend auto renders on the CPU; nothing if it renders on a GPU.
std::optional<std::string> why_on_cpu(const RenderOptions& options, const render::RenderSettings& settings) {
    if (options.checkpoint || options.display_server || options.isa)
        return "--checkpoint, --display-server and --isa are supported only there";
    return why_not_on_gpu(options, settings);
}

bool renders_on_cpu(const RenderOptions& options, const render::RenderSettings& settings) {
    if (options.backend != "auto") return options.backend == "cpu";
    const auto reason = why_on_cpu(options, settings);
    if (reason && !options.quiet) fmt::print(stderr, "rendering on the CPU: {}\n", *reason);
    return reason.has_value();
}

} // namespace

std::unique_ptr<render::Backend> make_backend(const RenderOptions& options,
                                              const render::RenderSettings& settings) {
    if (renders_on_cpu(options, settings))
        return std::make_unique<render_cpu::CpuBackend>(
            base::choose_isa(options.isa), options.threads.value_or(render_cpu::default_thread_count()));
    std::unique_ptr<render::Backend> gpu = make_gpu_backend(options);
    if (const auto reason = gpu->why_unsupported(settings)) throw std::invalid_argument(*reason);
    if (!options.quiet) fmt::print(stderr, "rendering on {}\n", gpu->metadata().at("device"));
    return gpu;
}

} // namespace nusselt::app
