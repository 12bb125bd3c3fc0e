#pragma once
/// Options that the benchmarks of whole frames share.

#include "base/isa.h"
#include "lab/results/results.h"
#include "proof/median.h"
#include "render/settings.h"
#include "scene/model/scene.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::app {

using proof::median;

/// Options of the benchmarks of whole frames.
struct BenchFramesOptions {
    std::filesystem::path scene;
    int samples = 1;
    int repetitions = 9;
    std::optional<int> threads;
    std::optional<std::string> resolution; ///< "WIDTHxHEIGHT"
    std::optional<std::string> isa;
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds SCENE, --spp, --repetitions, --threads, --isa and --resolution.
/// \param samples_of what --spp counts samples of, for its help
void add_frame_options(CLI::App& command, BenchFramesOptions& options, const std::string& samples_of);

/// Adds what add_line_kind_options() can change.
void append_line_kind(const render::LineSettings& lines,
                      std::vector<std::pair<std::string, lab::Cell>>& settings);

/// The settings of lab::Results that these options decide.
std::vector<std::pair<std::string, lab::Cell>>
frame_settings(const BenchFramesOptions& options, const scene::Scene& scene, base::Isa isa, int threads);

} // namespace nusselt::app
