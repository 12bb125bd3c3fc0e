#pragma once
/// What `nusselt render` renders with.

#include "render.h"

#include "render/backend.h"
#include "render/settings.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <string>

namespace nusselt::app {

/// Adds --backend, --device and --shadow-rays.
void add_backend_options(CLI::App& command, RenderOptions& options);

/// Adds --device and --shadow-rays.
void add_device_options(CLI::App& command, RenderOptions& options);

/// \throws CLI::ValidationError if an option is for the other backend
void check_backend_options(const RenderOptions& options);

/// The backend that is asked for; with `auto` a GPU where there is one, software devices aside, that supports these
/// settings.
/// \throws std::invalid_argument if it does not support the settings
/// \throws std::runtime_error if it is not there
std::unique_ptr<render::Backend> make_backend(const RenderOptions& options,
                                              const render::RenderSettings& settings);

// In render_vulkan.cpp, or render_without_gpu.cpp where the program is built without its GPU side.

/// Why --backend auto renders on the CPU; nothing if it does not. A device that was asked for by name is used in any case.
std::optional<std::string> why_not_on_gpu(const RenderOptions& options,
                                          const render::RenderSettings& settings);

/// \throws std::runtime_error if there is no such device
std::unique_ptr<render::Backend> make_gpu_backend(const RenderOptions& options);

} // namespace nusselt::app
