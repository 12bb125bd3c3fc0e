#include "render.h"
#include "apps/common/interrupt.h"
#include "apps/common/line_options.h"
#include "apps/common/progress.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt/scene/lights.h"
#include "checkpointer.h"
#include "frame_display.h"
#include "render_backend.h"
#include "render_files.h"
#include "render_report.h"
#include "render_settings.h"

#include "base/stopwatch.h"
#include "image/io.h"
#include "image/layers.h"
#include "render/checkpoint.h"
#include "render/frame.h"
#include "render/metadata.h"
#include "scene/rig/camera_file.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace nusselt::app {

namespace {

/// Writes the frame to all files, also if some of them cannot be written: hours of work may be in it. EXR files get all
/// layers and metadata, others the image alone.
/// \throws std::runtime_error at the end, about all files that could not be written
void write_outputs(const RenderOptions& options, const render::RenderSettings& settings,
                   const scene::Film& film, render::Frame&& frame, const image::Metadata& metadata) {
    const std::vector<std::filesystem::path> paths = output_paths(options, film);
    std::set<std::filesystem::path> written;
    std::string problems;
    const auto write = [&](const std::filesystem::path& path, const auto& write_file) {
        try {
            write_file();
            written.insert(path);
        } catch (const std::runtime_error& error) {
            problems += (problems.empty() ? "" : "; ") + std::string(error.what());
        }
    };
    for (const std::filesystem::path& path : paths)
        if (!image::is_exr(path))
            write(path, [&] { image::write_image(path, frame.image, metadata, options.exposure); });
    const image::LayeredImage layered = to_layered_image(std::move(frame), film, settings, metadata);
    for (const std::filesystem::path& path : paths)
        if (image::is_exr(path)) write(path, [&] { image::write_layers(path, layered); });
    for (const std::filesystem::path& path : paths)
        if (written.count(path) != 0) print_output(options, path);
    if (!problems.empty()) throw std::runtime_error(problems);
}

std::string check_display_address(const std::string& text) {
    try {
        static_cast<void>(image::parse_display_address(text));
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

/// \returns the exit code
int stop_without_image(const RenderOptions& options) {
    if (!options.quiet) fmt::print(stderr, "stopped before the first pixel; no image is written\n");
    return interrupted_exit_code();
}

/// Reports that the image is incomplete. \param work the work of which a fraction is finished
void print_stop(const RenderOptions& options, double finished, const std::string& work) {
    fmt::print(stderr, "stopped after {:.1f} % of the {}", 100 * finished, work);
    if (options.checkpoint)
        fmt::print(stderr, "; run the same command again to continue from '{}'",
                   options.checkpoint->string());
    fmt::print(stderr, "\n");
}

} // namespace

void setup_render(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand(
        "render",
        "Render the direct light of a scene. Ctrl-C stops early and writes the finished tiles, with\n"
        "the rest black; the exit code is then 130. A second Ctrl-C ends the program at once.");
    command->add_option("SCENE", options->scene, "Scene file in pbrt syntax, version 3 or 4")->required();
    command
        ->add_option(
            "-o,--output", options->outputs,
            "Image to write: .exr (with all settings in its metadata), .png, .hdr or .pfm. May be repeated.\n"
            "Default: the file name of the film, else that of the scene, with .exr, in the current folder")
        ->allow_extra_args(false);
    command
        ->add_option("--spp", options->samples,
                     fmt::format("Samples per pixel, light and technique, 1 to {}", render::kMaxSamples))
        ->check(CLI::Range(1, render::kMaxSamples))
        ->capture_default_str();
    add_sampling_options(*command, *options);
    command
        ->add_option(
            "--camera-rays", options->camera_rays,
            "Camera rays per pixel, a divisor of --spp. Default: same as --spp, or 1 with --pixel-center")
        ->check(CLI::Range(1, render::kMaxSamples));
    command->add_flag_callback(
        "--pixel-center",
        [options] { options->pixel_position = render::name_of(render::PixelPosition::center); },
        "Send all camera rays through pixel centres, to measure noise. Default: random positions\n"
        "within the pixel");
    add_line_options(*command, options->lines);
    add_rigs_option(*command, options->rigs);
    command->add_option(
        "--camera", options->camera,
        "Camera and image size in place of those of the scene: a JSON file in the format that\n"
        "`nusselt camera` prints. Default: the camera of the scene");
    add_backend_options(*command, *options);
    add_machine_options(*command, options->threads, options->isa);
    add_resolution_option(*command, options->resolution);
    command->add_option("--exposure", options->exposure, "Brighten PNG images by this many stops, -64 to 64")
        ->check(exposure())
        ->capture_default_str();
    add_layers_option(*command, options->layers);
    add_part_option(*command, options->part);
    command->add_option(
        "--checkpoint", options->checkpoint,
        "Store finished tiles in this file while rendering. After an interruption of any kind, the same\n"
        "command continues from it; the file is removed once the image is written. Default: none");
    command
        ->add_option("--checkpoint-interval", options->checkpoint_interval,
                     "Seconds between two checkpoints, 0.01 to 1e6")
        ->check(number(0.01, 1e6))
        ->capture_default_str();
    command
        ->add_option(
            "--display-server", options->display_server,
            "Show tiles as they are finished in the viewer tev, or in another one with its protocol, at\n"
            "HOST, HOST:PORT or [IPV6]:PORT. Default: none")
        ->check(check_display_address, "HOST[:PORT]");
    command->add_flag("-q,--quiet", options->quiet, "Print only errors: no warnings, no progress");
    command->add_option(
        "--json", options->json,
        "Write settings, times and numbers of rays as JSON to a file, or with - to the standard\n"
        "output. Default: none");
    command->callback([options, &exit_code] {
        check_combination(*options);
        exit_code = run_render(*options);
    });
}

int run_render(const RenderOptions& options) {
    const base::Stopwatch stopwatch;
    const render::RenderSettings settings = make_settings(options);
    check_outputs(options);
    const std::unique_ptr<render::Backend> backend = make_backend(options, settings);

    const InterruptGuard guard;
    scene::Scene scene = load_scene(options.scene, options.rigs);
    if (options.camera) apply_camera(scene::read_camera_file(*options.camera), scene);
    check_names(options, scene.film);
    apply_resolution(options.resolution, scene);
    Times times;
    times.load = stopwatch.seconds();
    if (!options.quiet) print_warnings(options, settings, scene);

    render::Frame frame = render::make_frame(scene, settings);
    image::Metadata metadata = render::make_metadata(scene, settings, *backend);
    if (!options.rigs.empty()) metadata["light_rigs"] = rig_names(options.rigs);
    std::optional<Checkpointer> checkpointer;
    if (options.checkpoint) {
        const image::Metadata run = describe_run(metadata, frame);
        load_checkpoint(*options.checkpoint, run, frame);
        checkpointer.emplace(*options.checkpoint, run, frame,
                             std::chrono::duration<double>(options.checkpoint_interval));
    }

    const std::unique_ptr<render::PreparedScene> prepared = backend->prepare(scene);
    if (interrupted) return stop_without_image(options);

    Progress progress(finished_fraction(frame));
    render::RenderMonitor monitor;
    monitor.cancel = &interrupted;
    if (!options.quiet) monitor.progress = [&](double fraction) { progress.update(fraction); };
    std::optional<FrameDisplay> display;
    if (options.display_server)
        display.emplace(*options.display_server,
                        output_paths(options, scene.film).front().filename().string(), frame,
                        [&](const std::string& warning) {
                            if (!options.quiet) fmt::print(stderr, "warning: {}\n", warning);
                        });
    monitor.tile_finished = [&](std::size_t tile) {
        if (checkpointer) checkpointer->add(tile);
        if (display) display->show(tile);
    };
    const render::RenderStatistics statistics = prepared->render_into(frame, settings, monitor);
    progress.finish();
    const double finished = finished_fraction(frame);
    if (finished == 0) return stop_without_image(options);

    const base::Stopwatch writing;
    // A finished image is saved too, because writing it may fail.
    const std::optional<std::string> unsaved = checkpointer ? checkpointer->save_all() : std::nullopt;
    metadata["scene"] = options.scene.filename().string();
    metadata["render_seconds"] = image::metadata_text(statistics.render_seconds);
    metadata["finished_fraction"] = image::metadata_text(finished);
    const std::string unfinished_work = frame.finished_share < 1 ? "camera rays" : "pixels";
    write_outputs(options, settings, scene.film, std::move(frame), metadata);
    if (unsaved && finished < 1) throw std::runtime_error(*unsaved);
    if (options.checkpoint && finished == 1) {
        std::error_code ignored;
        std::filesystem::remove(*options.checkpoint, ignored);
    }
    times.write = writing.seconds();
    times.total = stopwatch.seconds();
    if (options.json)
        write_report(*options.json, report_json(options, settings, scene, *backend, statistics, times));
    if (finished == 1) return 0;
    if (!options.quiet) print_stop(options, finished, unfinished_work);
    return interrupted_exit_code();
}

} // namespace nusselt::app
