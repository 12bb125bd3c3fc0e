#include "camera.h"
#include "apps/common/render_setup.h"

#include "scene/import/importers.h"
#include "scene/rig/camera_file.h"

#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

void setup_camera(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<CameraOptions>();
    CLI::App* const command = app.add_subcommand(
        "camera",
        "Print the camera of a scene and its image size as JSON, to edit and pass to `nusselt render\n"
        "--camera`");
    command->add_option("SCENE", options->scene, "Scene file in pbrt syntax, version 3 or 4")->required();
    add_resolution_option(*command, options->resolution);
    command->callback([options, &exit_code] { exit_code = run_camera(*options); });
}

int run_camera(const CameraOptions& options) {
    scene::Scene scene = scene::load_scene(options.scene);
    apply_resolution(options.resolution, scene);
    fmt::print("{}", scene::to_camera_text({scene.camera, scene.film.width, scene.film.height}));
    return 0;
}

} // namespace nusselt::app
