#include "program.h"

#include "scene/input/message.h"

#include <fmt/core.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

namespace nusselt::app {

namespace {

int report_lost_output(const Program& program) {
    fmt::print(stderr, "{}: error: the standard output cannot be written (is its disk full?)\n",
               program.name);
    return 1;
}

/// The exit code, or that of an error if text for the standard output was lost, whichever command wrote it.
int finished(const Program& program, int exit_code) {
    std::cout.flush();
    const bool written = std::cout.good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    return written || exit_code != 0 ? exit_code : report_lost_output(program);
}

} // namespace

int run_program(const Program& program, int argc, char** argv) {
    // Beyond a limit on the size of files, writing fails like on a full disk instead of ending the program.
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app(program.description);
    app.name(program.name);
    app.footer(program.footer);
    app.require_subcommand(1);
    app.set_version_flag("--version", program.name + " " NUSSELT_VERSION);
    app.set_help_all_flag("--help-all", "Print the help of all commands and exit");
    app.failure_message([&program](const CLI::App*, const CLI::Error& error) {
        return fmt::format("{}: {}; see --help\n", program.name, error.what());
    });
    int exit_code = 0;
    for (const SetupCommand setup : program.commands) setup(app, exit_code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool is_help = error.get_exit_code() == 0;
        app.exit(error);
        return is_help ? finished(program, 0) : 2;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr,
                   "{}: error: not enough memory; use a smaller scene, a smaller image or fewer layers\n",
                   program.name);
        return 1;
    } catch (const std::exception& error) {
        // Texts longer than the buffer of the stream are written, and lost, before the end of the command.
        if (std::ferror(stdout) != 0) return report_lost_output(program);
        fmt::print(stderr, "{}: error: {}\n", program.name, scene::message_line(error.what()));
        return 1;
    }
    return finished(program, exit_code);
}

} // namespace nusselt::app
