#include "apps/nusselt/view/view.h"

#include <CLI/CLI.hpp>

#include <stdexcept>

namespace nusselt::app {

int run_view(const ViewOptions&) {
    throw std::runtime_error("this program was built without the viewer; install libvulkan-dev, "
                             "glslang-tools, libglfw3-dev and libimgui-dev, then configure and build again");
}

void setup_view(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("view", "Show a scene in a window (not in this build).");
    command->allow_extras();
    command->callback([&exit_code] { exit_code = run_view({}); });
}

} // namespace nusselt::app
