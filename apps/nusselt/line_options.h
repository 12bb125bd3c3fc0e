#pragma once
/// Options for line samples.

#include "commands.h"

#include "render/settings.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

namespace nusselt::app {

/// Adds --light-samples and all that goes with it.
void add_line_options(CLI::App& command, LineOptions& options);

/// Adds --orientation, --offsets and --line-shading.
void add_line_kind_options(CLI::App& command, LineKindOptions& options);

/// Changes those settings that the options name.
/// \throws std::invalid_argument for values that the command line does not let through
void apply_line_kind_options(const LineKindOptions& options, render::LineSettings& settings);

/// The same for all options, and what is sampled.
void apply_line_options(const LineOptions& options, render::RenderSettings& settings);

/// What add_line_kind_options() can change, as an object.
nlohmann::ordered_json line_kind_json(const render::LineSettings& settings);

/// \throws CLI::ValidationError if there are options for line samples without these, or for what these cannot be
void check_line_options(const RenderOptions& options, render::Technique technique);

} // namespace nusselt::app
