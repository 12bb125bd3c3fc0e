#pragma once
/// `nusselt view SCENE`: a window to fly through a scene.

#include "apps/nusselt/render/render.h"

#include <filesystem>
#include <optional>

namespace CLI {
class App;
}

namespace nusselt::app {

struct ViewOptions {
    RenderOptions render; ///< initial options of the image
    std::optional<std::filesystem::path> script;
};

/// Adds the subcommand. Its callback stores the result of run_view() in exit_code, which must live until the
/// command line was parsed.
void setup_view(CLI::App& app, int& exit_code);

/// Shows a scene in a window until that is closed.
int run_view(const ViewOptions& options);

} // namespace nusselt::app
