#pragma once
/// `nusselt techniques`: what samples lights.

namespace CLI {
class App;
}

namespace nusselt::app {

/// Adds the subcommand. Its callback stores the result of run_techniques() in exit_code, which must live until the
/// command line was parsed.
void setup_techniques(CLI::App& app, int& exit_code);

/// Prints the table of techniques.
int run_techniques();

} // namespace nusselt::app
