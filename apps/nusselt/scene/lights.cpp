#include "lights.h"
#include "apps/common/help.h"
#include "apps/common/render_setup.h"

#include "base/file_checks.h"
#include "scene/import/importers.h"
#include "scene/rig/rig.h"
#include "scene/rig/rig_json.h"
#include "scene/rig/rig_text.h"

#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

void setup_lights(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<LightsOptions>();
    CLI::App* const command = app.add_subcommand(
        "lights",
        "Print the lights of a scene as a light rig, to edit and pass to `nusselt render --lights`.");
    add_scene_argument(*command, options->scene);
    add_rigs_option(*command, options->rigs);
    command->callback([options, &exit_code] { exit_code = run_lights(*options); });
}

int run_lights(const LightsOptions& options) {
    fmt::print("{}", scene::to_rig_text(load_scene(options.scene, options.rigs)));
    return 0;
}

void add_rigs_option(CLI::App& command, std::vector<std::filesystem::path>& rigs) {
    command
        .add_option(
            "--lights", rigs,
            "Light rig: a JSON file that adds, moves, changes or removes lights; see docs/lights.md. May be "
            "repeated; rigs are applied in the order given")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->default_str("the lights of the scene")
        ->group(kSceneGroup);
}

std::string rig_names(const std::vector<std::filesystem::path>& rigs) {
    std::string names;
    for (const std::filesystem::path& rig : rigs)
        names += (names.empty() ? "" : ", ") + rig.filename().string();
    return names;
}

scene::Scene load_scene(const std::filesystem::path& path, const std::vector<std::filesystem::path>& rigs) {
    std::vector<std::filesystem::path> files = {path};
    files.insert(files.end(), rigs.begin(), rigs.end());
    base::check_exist(files);
    std::vector<scene::Rig> loaded;
    for (const std::filesystem::path& rig : rigs) loaded.push_back(scene::read_rig(rig));
    scene::Scene scene = scene::load_scene(path);
    for (const scene::Rig& rig : loaded) scene::apply_rig(rig, scene);
    return scene;
}

} // namespace nusselt::app
