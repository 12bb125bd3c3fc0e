#pragma once
/// `nusselt-lab bench rays SCENE`

#include "bench_frames.h"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchRaysOptions : BenchFramesOptions {
    std::optional<std::string> json; ///< "-" is the standard output, instead of the table
};

/// Adds the subcommand. Its callback stores the result of run_bench_rays() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_rays(CLI::App& bench, int& exit_code);

/// Compares the time of rendering with that of tracing the same rays.
int run_bench_rays(const BenchRaysOptions& options);

} // namespace nusselt::app
