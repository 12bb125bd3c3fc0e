#pragma once
/// Code that the programs share: they read their command line and report errors in the same way.

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace nusselt::app {

/// Adds a subcommand. Its callback stores the exit code in exit_code, which must live until the command line was parsed.
using SetupCommand = void (*)(CLI::App& app, int& exit_code);

struct Program {
    std::string name; ///< as typed; messages begin with it
    std::string description;
    std::string footer;
    std::vector<SetupCommand> commands; ///< in the order of the help
};

/// Runs the subcommand that the arguments name.
/// \returns the exit code of the subcommand, 1 after an error, or 2 for wrong usage; errors are printed in one line
int run_program(const Program& program, int argc, char** argv);

} // namespace nusselt::app
