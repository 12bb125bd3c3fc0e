#pragma once
/// Options for line samples.

#include "render/settings.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>

namespace nusselt::app {

/// Options for line samples that do not depend on their number. Defaults are those of render::LineSettings.
struct LineKindOptions {
    std::optional<std::string> orientation;
    std::optional<std::string> offsets;
    std::optional<std::string> shading;
};

/// All options for line samples. Defaults are those of render::RenderSettings.
struct LineOptions : LineKindOptions {
    std::string light_samples = "points";
    bool has_old_name = false; ///< whether they were chosen by the name of earlier versions, --integrator
    std::optional<int> count;
    std::optional<std::string> many_occluders;
};

/// Adds --light-samples and the options that depend on it.
void add_line_options(CLI::App& command, LineOptions& options);

/// Adds --orientation, --offsets and --line-shading.
void add_line_kind_options(CLI::App& command, LineKindOptions& options);

/// Changes those settings that the options name.
/// \throws std::invalid_argument for values that the command line does not let through
void apply_line_kind_options(const LineKindOptions& options, render::LineSettings& settings);

/// Changes the choice of light samples too.
void apply_line_options(const LineOptions& options, render::RenderSettings& settings);

/// The settings that add_line_kind_options() can change, as an object.
nlohmann::ordered_json line_kind_json(const render::LineSettings& settings);

} // namespace nusselt::app
