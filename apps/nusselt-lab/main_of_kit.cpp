// The program `nusselt-lab` in the kit for machines with a GPU.

#include "apps/common/program.h"
#include "apps/nusselt-lab/frames/bench_gpu_frames.h"
#include "apps/nusselt-lab/gpu/gpu.h"
#include "apps/nusselt-lab/samplers/bench_gpu_samplers.h"

namespace {

void setup_gpu_benches(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("bench", "Measure the cost of samples and frames on a GPU.");
    command->require_subcommand(1);
    nusselt::app::setup_bench_gpu_samplers(*command, exit_code);
    nusselt::app::setup_bench_gpu_frames(*command, exit_code);
}

} // namespace

int main(int argc, char** argv) {
    using namespace nusselt::app;
    return run_program(
        {"nusselt-lab",
         "The part of Nusselt's laboratory that checks and measures GPUs.",
         "Examples:\n"
         "  nusselt-lab gpu device\n"
         "  nusselt-lab bench gpu scenes/room.pbrt\n"
         "\n"
         "`nusselt-lab COMMAND --help` explains a command.\n"
         "Exit codes: 0 success, 1 error or broken expectation, 2 wrong usage; 130 stopped by Ctrl-C,\n"
         "143 by SIGTERM, 129 by SIGHUP, 152 by SIGXCPU, 138 by SIGUSR1.",
         {setup_gpu_benches, setup_gpu}},
        argc, argv);
}
