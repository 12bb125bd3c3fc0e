#pragma once
/// `nusselt-lab bench emission-frames SCENE`

#include "bench_frames.h"

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchEmissionFramesOptions : BenchFramesOptions {
    BenchEmissionFramesOptions() { threads = 1; }
};

/// Adds the subcommand. Its callback stores the result of run_bench_emission_frames() in exit_code, which must live until
/// the command line was parsed.
void setup_bench_emission_frames(CLI::App& bench, int& exit_code);

/// Measures what textures, maps and profiles of lights cost.
int run_bench_emission_frames(const BenchEmissionFramesOptions& options);

} // namespace nusselt::app
