#include "apps/nusselt-lab/frames/bench_gpu_frames.h"
#include "apps/nusselt-lab/samplers/bench_gpu_samplers.h"

#include <CLI/CLI.hpp>

#include <stdexcept>

namespace nusselt::app {

namespace {

[[noreturn]] void fail() {
    throw std::runtime_error("this program was built without GPU support; install libvulkan-dev and "
                             "glslang-tools, then configure and build again");
}

} // namespace

int run_bench_gpu_samplers(const BenchGpuSamplersOptions&) { fail(); }

int run_bench_gpu_frames(const BenchGpuFramesOptions&) { fail(); }

void setup_bench_gpu_samplers(CLI::App& bench, int& exit_code) {
    CLI::App* command =
        bench.add_subcommand("gpu-samplers", "Cost of each technique on a GPU (not in this build).");
    command->allow_extras();
    command->callback([&exit_code] { exit_code = run_bench_gpu_samplers({}); });
}

void setup_bench_gpu_frames(CLI::App& bench, int& exit_code) {
    CLI::App* command = bench.add_subcommand("gpu", "Cost of frames on a GPU (not in this build).");
    command->allow_extras();
    command->callback([&exit_code] { exit_code = run_bench_gpu_frames({}); });
}

} // namespace nusselt::app
