#pragma once
/// `nusselt-lab bench lines SCENE`

#include "apps/common/line_options.h"
#include "bench_frames.h"

#include <vector>

namespace CLI {
class App;
}

namespace nusselt::app {

struct BenchLinesOptions : BenchFramesOptions {
    std::vector<int> counts = {4, 16, 64}; ///< of lines per shading point and light
    LineKindOptions lines;
};

/// Adds the subcommand. Its callback stores the result of run_bench_lines() in exit_code, which must live until the
/// command line was parsed.
void setup_bench_lines(CLI::App& bench, int& exit_code);

/// Measures what line samples cost, in shadow rays.
int run_bench_lines(const BenchLinesOptions& options);

} // namespace nusselt::app
