#pragma once
/// `nusselt-lab bench` measures costs, accuracy and noise.

namespace CLI {
class App;
}

namespace nusselt::app {

/// Adds the subcommand with one of its own for each benchmark. Their callbacks store their results in exit_code, which
/// must live until the command line was parsed.
void setup_bench(CLI::App& app, int& exit_code);

} // namespace nusselt::app
