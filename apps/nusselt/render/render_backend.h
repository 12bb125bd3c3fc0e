#pragma once
/// The choice of the backend of `nusselt render`.

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

/// The chosen backend before a scene is read; with `auto` a GPU if one is available, software devices aside, that supports
/// these settings.
/// \throws std::invalid_argument if it does not support the settings
/// \throws std::runtime_error if it is not there
std::unique_ptr<render::Backend> make_backend(const RenderOptions& options,
                                              const render::RenderSettings& settings);

/// The backend that renders a scene: the same, or with `auto` the CPU if it does not support the scene. Prints where it
/// renders.
/// \throws std::invalid_argument if the backend that was asked for does not support the scene with these settings
std::unique_ptr<render::Backend> backend_for(const scene::Scene& scene,
                                             std::unique_ptr<render::Backend> backend,
                                             const RenderOptions& options,
                                             const render::RenderSettings& settings);

// Defined in render_vulkan.cpp, or in render_without_gpu.cpp if the program is built without GPU support.

/// The reason for which --backend auto renders on the CPU; nothing if it renders on a GPU. A device chosen by name is
/// always used.
std::optional<std::string> why_not_on_gpu(const RenderOptions& options,
                                          const render::RenderSettings& settings);

/// \throws std::runtime_error if there is no such device
std::unique_ptr<render::Backend> make_gpu_backend(const RenderOptions& options);

} // namespace nusselt::app
