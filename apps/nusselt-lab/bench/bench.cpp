#include "bench.h"

#include "apps/nusselt-lab/frames/bench_emission_frames.h"
#include "apps/nusselt-lab/frames/bench_gpu_frames.h"
#include "apps/nusselt-lab/frames/bench_line_efficiency.h"
#include "apps/nusselt-lab/frames/bench_lines.h"
#include "apps/nusselt-lab/frames/bench_rays.h"
#include "apps/nusselt-lab/frames/bench_scale.h"
#include "apps/nusselt-lab/frames/bench_strategies.h"
#include "apps/nusselt-lab/samplers/bench_accuracy.h"
#include "apps/nusselt-lab/samplers/bench_emission.h"
#include "apps/nusselt-lab/samplers/bench_gpu_samplers.h"
#include "apps/nusselt-lab/samplers/bench_instructions.h"
#include "apps/nusselt-lab/samplers/bench_phong_lines.h"
#include "apps/nusselt-lab/samplers/bench_samplers.h"
#include "apps/nusselt-lab/samplers/bench_shadows.h"
#include "apps/nusselt-lab/samplers/bench_tubes.h"
#include "apps/nusselt-lab/samplers/bench_worst_case.h"

#include <CLI/CLI.hpp>

namespace nusselt::app {

void setup_bench(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand(
        "bench",
        "Measure the cost of rays and samples, the accuracy and noise of samples, and the largest scenes.");
    command->require_subcommand(1);
    setup_bench_rays(*command, exit_code);
    setup_bench_strategies(*command, exit_code);
    setup_bench_emission_frames(*command, exit_code);
    setup_bench_lines(*command, exit_code);
    setup_bench_line_efficiency(*command, exit_code);
    setup_bench_samplers(*command, exit_code);
    setup_bench_instructions(*command, exit_code);
    setup_bench_gpu_samplers(*command, exit_code);
    setup_bench_gpu_frames(*command, exit_code);
    setup_bench_accuracy(*command, exit_code);
    setup_bench_emission(*command, exit_code);
    setup_bench_worst_case(*command, exit_code);
    setup_bench_shadows(*command, exit_code);
    setup_bench_tubes(*command, exit_code);
    setup_bench_scale(*command, exit_code);
    setup_bench_phong_lines(*command, exit_code);
}

} // namespace nusselt::app
