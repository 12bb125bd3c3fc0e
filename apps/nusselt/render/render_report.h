#pragma once
/// The report of `nusselt render`.

#include "render.h"

#include "render/backend.h"
#include "render/frame.h"
#include "render/statistics.h"
#include "scene/model/scene.h"

#include <nlohmann/json.hpp>

#include <string>

namespace nusselt::app {

/// The times of the phases of a rendering [s].
struct Times {
    double load = 0;
    double write = 0;
    double total = 0;
};

/// Tells what may surprise a user about the image, on the standard error.
void print_warnings(const RenderOptions& options, const render::RenderSettings& settings,
                    const scene::Scene& scene);

/// Prints how much memory the image and its layers will take, on the standard error.
/// \param sum_bytes see Backend::layer_sum_bytes()
void print_layers(const render::FrameSize& size, std::size_t sum_bytes);

nlohmann::ordered_json report_json(const RenderOptions& options, const render::RenderSettings& settings,
                                   const scene::Scene& scene, const render::Backend& backend,
                                   const render::RenderStatistics& statistics, const Times& times);

/// \param target a file, or "-" for the standard output. \throws std::runtime_error if it cannot be written
void write_report(const std::string& target, const nlohmann::ordered_json& report);

} // namespace nusselt::app
