#pragma once
/// `nusselt-lab gpu` checks a GPU.

namespace CLI {
class App;
}

namespace nusselt::app {

/// Adds the subcommand with one of its own for each check. Their callbacks store their results in exit_code, which must
/// live until the command line was parsed.
void setup_gpu(CLI::App& app, int& exit_code);

/// Adds single checks. Programs without GPU support have them too, but they fail.
void setup_gpu_device(CLI::App& gpu, int& exit_code);
void setup_gpu_parity(CLI::App& gpu, int& exit_code);
void setup_gpu_agreement(CLI::App& gpu, int& exit_code);

/// Adds the report of all checks.
void setup_gpu_report(CLI::App& gpu, int& exit_code);

} // namespace nusselt::app
