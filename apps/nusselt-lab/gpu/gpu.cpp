#include "apps/nusselt-lab/gpu/gpu.h"

#include <CLI/CLI.hpp>

namespace nusselt::app {

void setup_gpu(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand(
        "gpu", "Check a GPU: what it supports, and whether its samples and images are right.");
    command->require_subcommand(1);
    setup_gpu_device(*command, exit_code);
    setup_gpu_parity(*command, exit_code);
    setup_gpu_agreement(*command, exit_code);
    setup_gpu_report(*command, exit_code);
}

} // namespace nusselt::app
