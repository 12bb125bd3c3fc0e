#include "render.h"
#include "apps/common/error_text.h"
#include "apps/common/help.h"
#include "apps/common/interrupt.h"
#include "apps/common/line_options.h"
#include "apps/common/print_message.h"
#include "apps/common/progress.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt/scene/camera.h"
#include "apps/nusselt/scene/lights.h"
#include "checkpointer.h"
#include "frame_display.h"
#include "render_backend.h"
#include "render_files.h"
#include "render_report.h"
#include "render_settings.h"

#include "base/file_checks.h"
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
#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::app {

namespace {

/// Files of which each is tried whether the others fail or not: hours of work may be in what they hold.
class Attempts {
public:
    /// \param write a step towards these files
    /// \returns whether it succeeded
    template <class Write>
    bool attempt(const std::vector<std::filesystem::path>& files, const Write& write) {
        try {
            write();
            return true;
        } catch (const std::exception& error) {
            add_failure(error_text(error, files));
            return false;
        }
    }

    void add_failure(const std::string& message) { failures_ += (failures_.empty() ? "" : "; ") + message; }
    bool has_failures() const { return !failures_.empty(); }

    /// \throws std::runtime_error about all failures, if there are any
    void report() const {
        if (has_failures()) throw std::runtime_error(failures_);
    }

private:
    std::string failures_;
};

/// Writes the frame to all files. EXR files get all layers and metadata, others the image alone.
void write_outputs(const RenderOptions& options, const render::RenderSettings& settings,
                   const scene::Film& film, render::Frame&& frame, const image::Metadata& metadata,
                   Attempts& attempts) {
    const std::vector<std::filesystem::path> paths = output_paths(options, film);
    std::vector<std::filesystem::path> exr_paths;
    std::set<std::filesystem::path> written;
    const auto write = [&](const std::filesystem::path& path, const auto& write_file) {
        if (attempts.attempt({path}, write_file)) written.insert(path);
    };
    for (const std::filesystem::path& path : paths)
        if (image::is_exr(path))
            exr_paths.push_back(path);
        else
            write(path, [&] { image::write_image(path, frame.image, metadata, options.exposure); });
    image::LayeredImage layered;
    const auto collect_layers = [&] {
        layered = to_layered_image(std::move(frame), film, settings, metadata);
    };
    if (!exr_paths.empty() && attempts.attempt(exr_paths, collect_layers))
        for (const std::filesystem::path& path : exr_paths)
            write(path, [&] { image::write_layers(path, layered); });
    for (const std::filesystem::path& path : paths)
        if (written.count(path) != 0) print_output(options, path);
}

std::string check_display_address(const std::string& text) {
    try {
        static_cast<void>(image::parse_display_address(text));
        return "";
    } catch (const std::exception& error) {
        return error.what();
    }
}

constexpr double kCheckpointInterval = 60; // [s]
const char* const kStoppedEarly = "stopped before rendering began; no image is written\n";
const char* const kCheckpointKept = "stopped before rendering went on; the checkpoint stays as it was\n";

/// Reports that the image is incomplete. \param finished fraction of the work
void print_stop(const RenderOptions& options, double finished) {
    // Rounded down, for only complete images have 100 %.
    print_message("stopped after {:.1f} % of the camera rays", std::floor(1000 * finished) / 10);
    if (options.checkpoint)
        print_message("; run the same command again to continue from '{}'", options.checkpoint->string());
    print_message("\n");
}

void add_output_options(CLI::App& command, RenderOptions& options) {
    command
        .add_option(
            "-o,--output", options.outputs,
            "Image to write: .exr (with all settings in its metadata), .png, .hdr or .pfm. May be repeated")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->default_str("the file name of the film, else that of the scene, with .exr, in the current folder")
        ->group(kOutputGroup);
    command.add_option("--exposure", options.exposure, "Brighten PNG images by this many stops")
        ->check(exposure())
        ->group(kOutputGroup);
    add_layers_option(command, options.layers);
    command
        .add_option(
            "--json", options.json,
            "Write settings, times and numbers of rays as JSON to a file, or with - to the standard output")
        ->type_name("FILE")
        ->default_str(kNone)
        ->group(kOutputGroup);
    command
        .add_option(
            "--display-server", options.display_server,
            "Show tiles as they are finished in the viewer tev, or in another one with its protocol, at "
            "HOST, HOST:PORT or [IPV6]:PORT")
        ->type_name("ADDRESS")
        ->check(check_display_address)
        ->default_str(kNone)
        ->group(kOutputGroup);
    command.add_flag("-q,--quiet", options.quiet, "Print only errors: no warnings, no progress")
        ->group(kOutputGroup);
}

void add_checkpoint_options(CLI::App& command, RenderOptions& options) {
    command
        .add_option("--checkpoint", options.checkpoint,
                    "Store what is finished in this file while rendering. After an interruption of any kind, "
                    "the same command continues from it; the file is removed once the image is written")
        ->type_name("FILE")
        ->default_str(kNone)
        ->group(kPartsGroup);
    command
        .add_option("--checkpoint-interval", options.checkpoint_interval, "Seconds between two checkpoints")
        ->check(number(0.01, 1e6))
        ->default_str(fmt::format("{}", kCheckpointInterval))
        ->group(kPartsGroup);
}

} // namespace

void add_render_options(CLI::App& command, RenderOptions& options) {
    add_scene_argument(command, options.scene);
    add_output_options(command, options);
    command.add_option("--spp", options.samples, "Samples per pixel, light and technique")
        ->transform(to_whole_number(1, render::kMaxSamples))
        ->default_str("what the Sampler of the scene asks for, or 1")
        ->group(kSamplingGroup);
    add_sampling_options(command, options);
    command.add_option("--camera-rays", options.camera_rays, "Camera rays per pixel, a divisor of --spp")
        ->transform(to_whole_number(1, render::kMaxSamples))
        ->default_str("the same as --spp, or 1 with --pixel-center")
        ->group(kSamplingGroup);
    command
        .add_flag_callback(
            "--pixel-center",
            [&options] { options.pixel_position = render::name_of(render::PixelPosition::center); },
            "Send all camera rays through pixel centres, to measure noise, in place of random positions "
            "within the pixel")
        ->group(kSamplingGroup);
    add_line_options(command, options.lines);
    add_rigs_option(command, options.rigs);
    add_camera_option(command, options.camera);
    add_resolution_option(command, options.resolution);
    add_backend_options(command, options);
    add_machine_options(command, options.threads, options.isa);
    add_part_option(command, options.part);
    add_checkpoint_options(command, options);
}

void setup_render(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand(
        "render", "Render the direct light of a scene. Ctrl-C stops early and writes what is there, with "
                  "the rest black; the exit code is then 130. A second Ctrl-C ends the program at once.");
    add_render_options(*command, *options);
    command->callback([options, &exit_code] {
        check_combination(*options);
        exit_code = run_render(*options);
    });
}

int run_render(const RenderOptions& options) {
    const base::Stopwatch stopwatch;
    render::RenderSettings settings = make_settings(options);
    check_outputs(options);
    base::check_exist(input_paths(options));
    std::unique_ptr<render::Backend> chosen = make_backend(options, settings);

    const bool goes_on = options.checkpoint && std::filesystem::exists(*options.checkpoint);
    const char* const last_words = goes_on ? kCheckpointKept : kStoppedEarly;
    InterruptGuard guard(options.quiet ? "" : InterruptGuard::kNotice, options.quiet ? "" : last_words);
    scene::Scene scene = load_scene(options.scene, options.rigs);
    if (options.camera) apply_camera(scene::read_camera_file(*options.camera), scene);
    check_names(options, scene);
    choose_samples(options, scene.film, settings);
    apply_resolution(options.resolution, scene);
    const std::unique_ptr<render::Backend> backend = backend_for(scene, std::move(chosen), options, settings);
    Times times;
    times.load = stopwatch.seconds();
    if (!options.quiet) {
        print_warnings(options, settings, scene);
        for (const std::string& warning : backend->warnings(scene, settings))
            print_message("warning: {}\n", warning);
    }

    const render::FrameSize size = render::frame_size(scene, settings);
    if (!options.quiet && size.layers > 0) print_layers(size, backend->layer_sum_bytes(scene, settings));
    render::Frame frame = render::make_frame(scene, settings);
    image::Metadata metadata = render::make_metadata(scene, settings, *backend);
    if (!options.rigs.empty()) metadata["light_rigs"] = rig_names(options.rigs);
    std::optional<Checkpointer> checkpointer;
    if (options.checkpoint) {
        const image::Metadata run = describe_run(metadata, frame);
        load_checkpoint(*options.checkpoint, run, frame);
        checkpointer.emplace(
            *options.checkpoint, run, frame,
            std::chrono::duration<double>(options.checkpoint_interval.value_or(kCheckpointInterval)));
    }

    const std::unique_ptr<render::PreparedScene> prepared = backend->prepare(scene);
    Progress progress(finished_fraction(frame));
    render::RenderMonitor monitor;
    monitor.cancel = &interrupted;
    monitor.started = [&] { guard.stop_in_order(); };
    if (!options.quiet) monitor.progress = [&](double fraction) { progress.update(fraction); };
    std::optional<FrameDisplay> display;
    if (options.display_server)
        display.emplace(*options.display_server,
                        output_paths(options, scene.film).front().filename().string(), frame,
                        [&](const std::string& warning) {
                            if (!options.quiet) print_message("warning: {}\n", warning);
                        });
    monitor.tile_finished = [&](std::size_t tile) {
        if (checkpointer) checkpointer->add(tile);
        if (display) display->show(tile);
    };
    const render::RenderStatistics statistics = prepared->render_into(frame, settings, monitor);
    progress.finish();
    const double finished = finished_fraction(frame);
    const base::Stopwatch writing;
    // A finished image is saved too, because writing it may fail.
    const std::optional<std::string> unsaved = checkpointer ? checkpointer->save_all() : std::nullopt;
    if (finished == 0) {
        if (unsaved) throw std::runtime_error(*unsaved);
        if (!options.quiet) print_message("stopped before the first pixel; no image is written\n");
        return interrupted_exit_code();
    }

    metadata["scene"] = options.scene.filename().string();
    metadata["render_seconds"] = image::metadata_text(statistics.render_seconds);
    metadata["finished_fraction"] = image::metadata_text(finished);
    Attempts attempts;
    write_outputs(options, settings, scene.film, std::move(frame), metadata, attempts);
    if (unsaved && finished < 1) attempts.add_failure(*unsaved);
    if (options.checkpoint && finished == 1 && !attempts.has_failures()) {
        // A symbolic link stays, as it does for images.
        std::error_code ignored;
        std::filesystem::remove(std::filesystem::weakly_canonical(*options.checkpoint, ignored), ignored);
    }
    times.write = writing.seconds();
    times.total = stopwatch.seconds();
    if (options.json)
        attempts.attempt({*options.json}, [&] {
            write_report(*options.json, report_json(options, settings, scene, *backend, statistics, times));
        });
    attempts.report();
    if (finished == 1) return 0;
    if (!options.quiet) print_stop(options, finished);
    return interrupted_exit_code();
}

} // namespace nusselt::app
