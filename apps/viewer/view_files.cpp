#include "view_files.h"

#include "base/atomic_file.h"
#include "base/file_checks.h"
#include "base/words.h"
#include "image/io.h"
#include "image/srgb.h"
#include "render/film.h"
#include "scene/rig/camera_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace nusselt::viewer {

namespace {

void write_text(const std::filesystem::path& path, const std::string& text) {
    base::write_atomically(path, [&](std::ofstream& stream) { stream << text; });
}

/// The picture of a window as radiance that becomes the same bytes in a PNG file.
image::Image to_linear(const render_vulkan::DisplayPass& picture) {
    std::array<float, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i)
        linear[i] = static_cast<float>(image::linear_from_srgb(static_cast<double>(i) / 255));
    image::Image image =
        image::make_image(static_cast<int>(picture.width()), static_cast<int>(picture.height()));
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = linear[picture.pixels()[i / 3] >> (8 * (i % 3)) & 0xff];
    return image;
}

std::filesystem::path with_suffix(const std::filesystem::path& path, const std::string& suffix) {
    return path.parent_path() / (path.stem().string() + suffix);
}

} // namespace

std::string command_of(const Session& session, const ViewState& state, const SceneFiles& files,
                       const std::filesystem::path& camera,
                       const std::optional<std::filesystem::path>& lights,
                       const std::filesystem::path& output) {
    const render::RenderSettings& settings = state.of(Side::left);
    std::string command = "nusselt render " + base::shell_word(files.scene.string());
    for (const std::filesystem::path& rig : files.rigs)
        command += " --lights " + base::shell_word(rig.string());
    if (lights) command += " --lights " + base::shell_word(lights->string());
    command += " --camera " + base::shell_word(camera.string()) + " --backend vulkan";
    if (files.device) command += " --device " + base::shell_word(*files.device);
    command += fmt::format(" --shadow-rays {} --technique {} --strategies {}", name_of(session.shadow_rays()),
                           name_of(settings.technique), name_of(settings.strategies));
    if (settings.strategies != render::Strategies::diffuse) {
        command += fmt::format(" --mis {}", name_of(settings.mis));
        if (uses_visibility_estimate(settings.mis))
            command += fmt::format(" --visibility-estimate {}", settings.visibility_estimate);
    }
    command += fmt::format(" --sampler {} --brdf {}", name_of(settings.sample_order), name_of(settings.brdf));
    // The image of a single frame is reproduced up to rounding, that of several frames up to noise.
    const std::int64_t frames = std::max<std::int64_t>(session.frames(Side::left), 1);
    const std::int64_t samples = std::min<std::int64_t>(frames * settings.samples, render::kMaxSamples);
    command += fmt::format(" --spp {}", samples);
    if (frames == 1) command += " --camera-rays 1";
    command += fmt::format(" --seed {}", frames == 1 ? session.seed(Side::left) : settings.seed);
    if (state.exposure != 0) command += fmt::format(" --exposure {}", state.exposure);
    return command + " -o " + base::shell_word(output.string());
}

std::string write_screenshot(const std::filesystem::path& path, const Session& session,
                             const ViewState& state, const SceneFiles& files) {
    const bool is_picture = image::lower_case_extension(path) == ".png";
    std::optional<std::filesystem::path> right;
    if (!is_picture && state.is_split) right = with_suffix(path, "-right" + path.extension().string());
    const std::filesystem::path camera = camera_file_of(path);
    std::optional<std::filesystem::path> lights;
    if (!state.edits.empty()) lights = lights_file_of(path);
    std::vector<std::filesystem::path> outputs = {path, camera};
    if (right) outputs.push_back(*right);
    if (lights) outputs.push_back(*lights);
    base::check_distinct(outputs, files.inputs);

    image::write_image(path, is_picture ? to_linear(session.picture()) : session.image(Side::left));
    if (right) image::write_image(*right, session.image(Side::right));
    save_camera(camera, session, state, files);
    if (lights) save_lights(*lights, session, state, files);
    return command_of(session, state, files, camera, lights,
                      with_suffix(path, "-again" + path.extension().string()));
}

std::filesystem::path camera_file_of(const std::filesystem::path& screenshot) {
    return with_suffix(screenshot, ".camera.json");
}

std::filesystem::path lights_file_of(const std::filesystem::path& screenshot) {
    return with_suffix(screenshot, ".lights.json");
}

void save_camera(const std::filesystem::path& path, const Session& session, const ViewState& state,
                 const SceneFiles& files) {
    base::check_distinct({path}, files.inputs);
    const scene::Film& film = session.loaded().film;
    write_text(path, scene::to_camera_text({state.camera.camera(), film.width, film.height}));
}

void load_camera(const std::filesystem::path& path, const Session& session, ViewState& state) {
    const scene::Film& film = session.loaded().film;
    scene::Scene view;
    apply_camera(scene::read_camera_file(path), view);
    render::resize_film(view, film.width, film.height);
    state.camera = FlyCamera(view.camera, film.width, film.height);
}

void save_lights(const std::filesystem::path& path, const Session& session, const ViewState& state,
                 const SceneFiles& files) {
    base::check_distinct({path}, files.inputs);
    write_text(path, state.edits.rig_text(session.loaded()));
}

} // namespace nusselt::viewer
