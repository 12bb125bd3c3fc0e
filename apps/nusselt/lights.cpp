#include "commands.h"
#include "render_setup.h"

#include "scene/rig_text.h"

#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

void setup_lights(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<LightsOptions>();
    CLI::App* const command = app.add_subcommand(
        "lights",
        "Print the lights of a scene as a light rig, to be edited and given to --lights of `nusselt\n"
        "render`");
    command->add_option("SCENE", options->scene, "Scene file in pbrt syntax, version 3 or 4")->required();
    add_rigs_option(*command, options->rigs);
    command->callback([options, &exit_code] { exit_code = run_lights(*options); });
}

int run_lights(const LightsOptions& options) {
    fmt::print("{}", scene::to_rig_text(load_scene(options.scene, options.rigs)));
    return 0;
}

} // namespace nusselt::app
