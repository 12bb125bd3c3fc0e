#pragma once
/// `nusselt-lab bench rays SCENE`

#include "bench_frames.h"

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchRaysOptions : BenchFramesOptions {};

/// Adds the subcommand. Its callback stores the result of run_bench_rays() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_rays(CLI::App& bench, int& exit_code);

/// Compares the time of rendering with that of tracing the same rays.
int run_bench_rays(const BenchRaysOptions& options);

} // namespace nusselt::app
