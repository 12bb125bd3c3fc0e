#include "render_backend.h"

#include "apps/common/render_setup.h"

#include <array>
#include <string>
#include <utility>

namespace nusselt::app {

void add_backend_options(CLI::App& command, RenderOptions& options) {
    command
        .add_option("--backend", options.backend,
                    "What renders: cpu; vulkan, a GPU; or auto, a GPU if there is one, else the CPU")
        ->check(CLI::IsMember({"cpu", "vulkan", "auto"}))
        ->capture_default_str();
    add_device_options(command, options);
}

void add_device_options(CLI::App& command, RenderOptions& options) {
    command.add_option("--device", options.device,
                       "GPU, by its index or a part of its name. Default: the environment variable\n"
                       "NUSSELT_DEVICE, else the fastest kind");
    command
        .add_option("--shadow-rays", options.shadow_rays,
                    "How a GPU traces shadow rays: query, by its driver; bvh, by a hierarchy of our own;\n"
                    "or none, for an image without shadows. Default: query where the device has that\n"
                    "in hardware")
        ->check(CLI::IsMember({"query", "bvh", "none"}));
}

void check_backend_options(const RenderOptions& options) {
    const auto refuse = [](const std::string& option, const std::string& backend) {
        throw CLI::ValidationError(option, "that is for --backend " + backend);
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

} // namespace nusselt::app
