#pragma once
/// What benchmarks of whole frames share.

#include "commands.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace nusselt::app {

/// Adds SCENE, --spp, --repetitions, --threads, --isa and --resolution.
/// \param samples_of what --spp counts samples of, for its help
void add_frame_options(CLI::App& command, BenchFramesOptions& options, const std::string& samples_of);

/// Of at least one value; of an even number, the larger one of those in the middle.
double median(std::vector<double> values);

} // namespace nusselt::app
