#include "camera.h"
#include "apps/common/help.h"
#include "apps/common/render_setup.h"

#include "image/image.h"
#include "scene/import/importers.h"
#include "scene/rig/camera_file.h"

#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

void setup_camera(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<CameraOptions>();
    CLI::App* const command =
        app.add_subcommand("camera", "Print the camera of a scene and its image size as JSON, to edit and "
                                     "pass to `nusselt render --camera`.");
    add_scene_argument(*command, options->scene);
    add_resolution_option(*command, options->resolution);
    command->callback([options, &exit_code] { exit_code = run_camera(*options); });
}

void add_camera_option(CLI::App& command, std::optional<std::filesystem::path>& camera) {
    command
        .add_option(
            "--camera", camera,
            "Camera and image size in place of those of the scene: a JSON file in the format that `nusselt "
            "camera` prints")
        ->type_name("FILE")
        ->default_str("the camera of the scene")
        ->group(kSceneGroup);
}

int run_camera(const CameraOptions& options) {
    scene::Scene scene = scene::load_scene(options.scene);
    apply_resolution(options.resolution, scene);
    // A camera of a file has no crop.
    image::check_size(scene.film.width, scene.film.height);
    fmt::print("{}", scene::to_camera_text({scene.camera, scene.film.width, scene.film.height}));
    return 0;
}

} // namespace nusselt::app
