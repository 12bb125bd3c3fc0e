#include "commands.h"
#include "compare.h"
#include "info.h"
#include "lights.h"

#include "scene/input/message.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

namespace {

/// The exit code, or that of an error if text for the standard output was lost, whichever command wrote it.
int finished(int exit_code) {
    std::cout.flush();
    const bool written = std::cout.good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (written || exit_code != 0) return exit_code;
    fmt::print(stderr, "nusselt: error: the standard output cannot be written (is its disk full?)\n");
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    using namespace nusselt::app;
    // Beyond a limit on the size of files, writing fails like on a full disk instead of ending the program.
    std::signal(SIGXFSZ, SIG_IGN);
    CLI::App app("Nusselt: renders direct light of polygonal and linear lights with little noise.\n"
                 "`nusselt COMMAND --help` tells more.");
    app.name("nusselt");
    app.footer(
        "Exit codes: 0 success, 1 error, 2 wrong usage, 3 broken limit of compare, 130 stopped by Ctrl-C.");
    app.require_subcommand(1);
    app.set_version_flag("--version", "nusselt " NUSSELT_VERSION);
    app.set_help_all_flag("--help-all", "Print the help of all commands and exit");
    app.failure_message([](const CLI::App*, const CLI::Error& error) {
        return fmt::format("nusselt: {}; see --help\n", error.what());
    });
    int exit_code = 0;
    setup_render(app, exit_code);
    setup_view(app, exit_code);
    setup_merge(app, exit_code);
    setup_info(app, exit_code);
    setup_lights(app, exit_code);
    setup_camera(app, exit_code);
    setup_techniques(app, exit_code);
    setup_compare(app, exit_code);
    setup_convert(app, exit_code);
    setup_bench(app, exit_code);
    setup_reproduce(app, exit_code);
    setup_map(app, exit_code);
    setup_fit_ltc(app, exit_code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool is_help = error.get_exit_code() == 0;
        app.exit(error);
        return is_help ? finished(0) : 2;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr,
                   "nusselt: error: not enough memory; take a smaller scene, image or number of layers\n");
        return 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "nusselt: error: {}\n", nusselt::scene::message_line(error.what()));
        return 1;
    }
    return finished(exit_code);
}
