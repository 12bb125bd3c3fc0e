#pragma once
/// What benchmarks of whole frames share.

#include "commands.h"

#include "experiments/median.h"

#include <CLI/CLI.hpp>

#include <string>

namespace nusselt::app {

using experiments::median;

/// Adds SCENE, --spp, --repetitions, --threads, --isa and --resolution.
/// \param samples_of what --spp counts samples of, for its help
void add_frame_options(CLI::App& command, BenchFramesOptions& options, const std::string& samples_of);

} // namespace nusselt::app
