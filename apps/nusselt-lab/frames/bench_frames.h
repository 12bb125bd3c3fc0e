#pragma once
/// What benchmarks of whole frames share.

#include "proof/median.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace nusselt::app {

using proof::median;

/// Of benchmarks of whole frames.
struct BenchFramesOptions {
    std::filesystem::path scene;
    int samples = 1;
    int repetitions = 9;
    std::optional<int> threads;
    std::optional<std::string> resolution; ///< "WIDTHxHEIGHT"
    std::optional<std::string> isa;
};

/// Adds SCENE, --spp, --repetitions, --threads, --isa and --resolution.
/// \param samples_of what --spp counts samples of, for its help
void add_frame_options(CLI::App& command, BenchFramesOptions& options, const std::string& samples_of);

} // namespace nusselt::app
