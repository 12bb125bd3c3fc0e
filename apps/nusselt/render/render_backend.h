#pragma once
/// `nusselt render` on a GPU.

#include "render.h"
#include "render_report.h"

#include "render/settings.h"
#include "scene/model/scene.h"

#include <CLI/CLI.hpp>

#include <chrono>

namespace nusselt::app {

/// Adds --backend, --device and --shadow-rays.
void add_backend_options(CLI::App& command, RenderOptions& options);

/// Adds --device and --shadow-rays.
void add_device_options(CLI::App& command, RenderOptions& options);

/// \throws CLI::ValidationError if an option is for the other backend
void check_backend_options(const RenderOptions& options);

/// Whether the GPU renders, as asked for; with `auto` it does where there is one, software devices aside, that knows these
/// settings.
/// \throws std::runtime_error if it is asked for and cannot render
bool renders_on_gpu(const RenderOptions& options, const render::RenderSettings& settings);

/// Renders and writes the images.
/// \param times of what is done already
/// \returns 0, or 130 if it was interrupted
int render_on_gpu(const RenderOptions& options, const render::RenderSettings& settings,
                  const scene::Scene& scene, Times times, std::chrono::steady_clock::time_point begin);

} // namespace nusselt::app
