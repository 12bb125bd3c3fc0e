#include "commands.h"
#include "interrupt.h"
#include "lights.h"
#include "progress.h"
#include "render_setup.h"

#include "image/atomic_file.h"
#include "image/io.h"
#include "render_cpu/film.h"
#include "render_cpu/renderer.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>
#include <stdexcept>

namespace nusselt::app {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// As asked for. By default a technique for each component of the BRDF, if there are two and techniques for them.
render_cpu::Strategies strategies_of(const RenderOptions& options, render_cpu::Technique technique,
                                     render_cpu::BrdfChoice brdf) {
    if (options.strategies) return from_name(render_cpu::kStrategies, *options.strategies);
    const auto both = render_cpu::Strategies::diffuse_ltc;
    const bool useful = brdf == render_cpu::BrdfChoice::material;
    return useful && allows(technique, both) ? both : render_cpu::Strategies::diffuse;
}

render_cpu::RenderSettings make_settings(const RenderOptions& options) {
    render_cpu::RenderSettings settings;
    settings.technique = from_name(render_cpu::kTechniques, options.technique);
    settings.brdf = from_name(render_cpu::kBrdfChoices, options.brdf);
    settings.strategies = strategies_of(options, settings.technique, settings.brdf);
    if (options.mis)
        settings.mis = from_name(render_cpu::kMisHeuristics, *options.mis);
    else if (!allows(settings.strategies, settings.mis))
        settings.mis = render_cpu::Mis::balance;
    if (options.visibility_estimate) settings.visibility_estimate = *options.visibility_estimate;
    settings.sample_order = from_name(render_cpu::kSampleOrders, options.sampler);
    settings.pixel_position = from_name(render_cpu::kPixelPositions, options.pixel_position);
    settings.samples = options.samples;
    settings.camera_rays = options.camera_rays;
    settings.seed = options.seed;
    render_cpu::validate(settings);
    return settings;
}

/// Throws CLI::ValidationError if choices that are possible by themselves do not fit together.
void check_combination(const RenderOptions& options) {
    const auto technique = from_name(render_cpu::kTechniques, options.technique);
    const auto brdf = from_name(render_cpu::kBrdfChoices, options.brdf);
    const auto strategies = strategies_of(options, technique, brdf);
    if (!allows(technique, strategies)) {
        std::vector<std::string_view> others;
        for (const auto other : render_cpu::kTechniques)
            if (allows(other, strategies)) others.push_back(name_of(other));
        throw CLI::ValidationError("--strategies",
                                   fmt::format("{} needs --technique {}, not {}", name_of(strategies),
                                               fmt::join(others, " or "), options.technique));
    }
    if (strategies == render_cpu::Strategies::diffuse && (options.mis || options.visibility_estimate))
        throw CLI::ValidationError(options.mis ? "--mis" : "--visibility-estimate",
                                   "there is nothing to combine with --strategies diffuse");
    if (options.mis && !allows(strategies, from_name(render_cpu::kMisHeuristics, *options.mis))) {
        std::vector<std::string_view> others;
        for (const auto other : render_cpu::kMisHeuristics)
            if (allows(strategies, other)) others.push_back(name_of(other));
        throw CLI::ValidationError(
            "--mis", fmt::format("{} weighs techniques by what they contribute without shadows, "
                                 "which is not known for {}; take {}",
                                 *options.mis, name_of(strategies), fmt::join(others, " or ")));
    }
}

std::vector<std::filesystem::path> output_paths(const RenderOptions& options, const scene::Film& film) {
    if (!options.outputs.empty()) return options.outputs;
    const bool is_named = !film.filename.empty();
    const std::filesystem::path name = is_named ? std::filesystem::path(film.filename) : options.scene;
    return {name.filename().replace_extension(".exr")};
}

/// Throws std::runtime_error if something could not be written after the work is done.
void check_outputs(const RenderOptions& options) {
    // The name that the scene may give to the default image is unknown yet, its folder is not.
    for (const std::filesystem::path& path : output_paths(options, scene::Film()))
        image::check_writable_image(path);
    if (options.json && options.json != "-") image::check_writable(*options.json);
}

struct Times {
    double load = 0;
    double write = 0;
    double total = 0;
};

nlohmann::ordered_json report_json(const RenderOptions& options, const render_cpu::RenderSettings& settings,
                                   render_cpu::Isa isa, const scene::Scene& scene,
                                   const render_cpu::RenderStatistics& statistics, const Times& times) {
    const auto rate = [](std::uint64_t rays, double seconds) {
        return seconds > 0 ? static_cast<double>(rays) / seconds : 0.0;
    };
    const bool is_combined = settings.strategies != render_cpu::Strategies::diffuse;
    return {
        {"scene", options.scene.string()},
        {"triangles", scene.triangles.size()},
        {"width", scene.film.width},
        {"height", scene.film.height},
        {"technique", render_cpu::name_of(settings.technique)},
        {"strategies", render_cpu::name_of(settings.strategies)},
        {"mis", is_combined ? nlohmann::ordered_json(render_cpu::name_of(settings.mis)) : nullptr},
        {"visibility_estimate", is_combined ? nlohmann::ordered_json(settings.visibility_estimate) : nullptr},
        {"samples", settings.samples},
        {"camera_rays", render_cpu::camera_ray_count(settings)},
        {"pixel_position", render_cpu::name_of(settings.pixel_position)},
        {"sampler", render_cpu::name_of(settings.sample_order)},
        {"brdf", render_cpu::name_of(settings.brdf)},
        {"seed", settings.seed},
        {"isa", render_cpu::name_of(isa)},
        {"threads", statistics.threads},
        {"seconds",
         {{"load", times.load},
          {"bvh", statistics.build_seconds},
          {"render", statistics.render_seconds},
          {"write", times.write},
          {"total", times.total}}},
        {"thread_seconds",
         {{"primary_rays", statistics.primary_seconds},
          {"shading", statistics.shading_seconds},
          {"shadow_rays", statistics.shadow_seconds}}},
        {"rays", {{"primary", statistics.primary_rays}, {"shadow", statistics.shadow_rays}}},
        {"rejected_samples", statistics.rejected_samples},
        {"rays_per_thread_second",
         {{"primary", rate(statistics.primary_rays, statistics.primary_seconds)},
          {"shadow", rate(statistics.shadow_rays, statistics.shadow_seconds)}}},
        {"rays_per_second",
         rate(statistics.primary_rays + statistics.shadow_rays, statistics.render_seconds)},
    };
}

void write_report(const std::string& target, const nlohmann::ordered_json& report) {
    // Paths may hold bytes that are not UTF-8.
    const std::string text = report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    if (target == "-") {
        fmt::print("{}\n", text);
    } else {
        image::write_atomically(target, [&](std::ostream& stream) { stream << text << "\n"; });
    }
}

} // namespace

void setup_render(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand(
        "render", "Render direct light of a scene. Ctrl-C stops early and writes what is finished, the rest\n"
                  "black; the exit code is then 130.");
    command->add_option("SCENE", options->scene, "Scene file in pbrt syntax, version 3 or 4")->required();
    command
        ->add_option(
            "-o,--output", options->outputs,
            "Image to write: .exr (all settings in its metadata), .png or .hdr. May be repeated.\n"
            "Default: the file name of the film, else of the scene, with .exr, in the current folder")
        ->allow_extra_args(false);
    command
        ->add_option("--spp", options->samples,
                     fmt::format("Samples per pixel, light and technique, 1 to {}", render_cpu::kMaxSamples))
        ->check(CLI::Range(1, render_cpu::kMaxSamples))
        ->capture_default_str();
    command->add_option("--technique", options->technique, "How lights are sampled; see `nusselt techniques`")
        ->transform(to_name_of(render_cpu::kTechniques))
        ->capture_default_str();
    command
        ->add_option(
            "--strategies", options->strategies,
            "Which techniques take samples: diffuse, only that of --technique; diffuse+ltc, that one for\n"
            "the diffuse component of materials and linearly transformed cosines for the specular one; or\n"
            "the same with GGX visible normals, for polygons only. Default: diffuse+ltc with techniques of\n"
            "projected solid angles and --brdf material, else diffuse")
        ->transform(to_name_of(render_cpu::kStrategies));
    command
        ->add_option(
            "--mis", options->mis,
            "How the samples of two techniques are combined: a heuristic of multiple importance\n"
            "sampling, one sample of either technique, or each component estimated separately. Default:\n"
            "clamped_optimal, but balance with GGX visible normals")
        ->transform(to_name_of(render_cpu::kMisHeuristics));
    command
        ->add_option(
            "--visibility-estimate", options->visibility_estimate,
            "Share of lights that is visible, roughly, for --mis clamped_optimal and optimal; only noise\n"
            "depends on it. Default: 0.5")
        ->check(CLI::Range(0.0f, 1.0f));
    command
        ->add_option("--sampler", options->sampler,
                     "Random numbers: independent, Owen-scrambled Sobol' points, or uniform jittered (best\n"
                     "for linear lights)")
        ->transform(to_name_of(render_cpu::kSampleOrders))
        ->capture_default_str();
    command
        ->add_option(
            "--camera-rays", options->camera_rays,
            "Camera rays per pixel, a divisor of --spp. Default: as --spp, but 1 with --pixel-center")
        ->check(CLI::Range(1, render_cpu::kMaxSamples));
    command->add_flag_callback(
        "--pixel-center",
        [options] { options->pixel_position = render_cpu::name_of(render_cpu::PixelPosition::center); },
        "Send all camera rays through pixel centres, to measure noise. Default: random positions in\n"
        "the pixel");
    command
        ->add_option("--brdf", options->brdf, "BRDFs of the materials, or Lambertian ones with their albedo")
        ->transform(to_name_of(render_cpu::kBrdfChoices))
        ->capture_default_str();
    command->add_option("--seed", options->seed, "Chooses the random numbers, 0 to 2^32 - 1")
        ->capture_default_str();
    add_rigs_option(*command, options->rigs);
    add_machine_options(*command, options->threads, options->isa);
    add_resolution_option(*command, options->resolution);
    command->add_option("--exposure", options->exposure, "Brightens PNG images by this many stops, -64 to 64")
        ->check(CLI::Range(-64.0, 64.0))
        ->capture_default_str();
    command->add_flag("-q,--quiet", options->quiet, "Print errors only, no warnings and no progress");
    command->add_option(
        "--json", options->json,
        "Write settings, times and numbers of rays as JSON to a file, or with - to the standard output.\n"
        "Default: none");
    command->callback([options, &exit_code] {
        if (options->camera_rays && options->samples % *options->camera_rays != 0)
            throw CLI::ValidationError("--camera-rays", fmt::format("{} does not divide --spp, which is {}",
                                                                    *options->camera_rays, options->samples));
        check_combination(*options);
        exit_code = run_render(*options);
    });
}

int run_render(const RenderOptions& options) {
    const auto begin = Clock::now();
    const render_cpu::RenderSettings settings = make_settings(options);
    const render_cpu::Isa isa = render_cpu::choose_isa(options.isa);
    check_outputs(options);

    const InterruptGuard guard;
    scene::Scene scene = load_scene(options.scene, options.rigs);
    apply_resolution(options.resolution, scene);
    Times times;
    times.load = seconds_since(begin);
    if (!options.quiet) {
        for (const std::string& warning : scene.warnings) fmt::print(stderr, "warning: {}\n", warning);
        if (samples_visible_normals(settings.strategies) && !scene.line_lights.empty())
            fmt::print(stderr,
                       "warning: {} tubes and lines are sampled by {} alone: visible normals are for "
                       "polygons, no sample "
                       "ever hits a line\n",
                       scene.line_lights.size(), name_of(settings.technique));
    }

    const int threads = options.threads.value_or(render_cpu::default_thread_count());
    const render_cpu::Renderer renderer(scene, threads);
    if (interrupted) {
        if (!options.quiet) fmt::print(stderr, "stopped before the first pixel; no image is written\n");
        return kInterruptedExitCode;
    }

    Progress progress;
    render_cpu::RenderMonitor monitor;
    monitor.cancel = &interrupted;
    if (!options.quiet) monitor.progress = [&](double fraction) { progress.update(fraction); };
    const render_cpu::RenderResult result = renderer.render(settings, isa, monitor);
    progress.finish();

    const auto write_begin = Clock::now();
    image::Metadata metadata = render_cpu::make_metadata(settings, isa, result);
    metadata["scene"] = options.scene.filename().string();
    for (const std::filesystem::path& path : output_paths(options, scene.film)) {
        image::write_image(path, result.image, metadata, options.exposure);
        if (!options.quiet && options.json != "-") fmt::print("{}\n", path.string());
    }
    times.write = seconds_since(write_begin);
    times.total = seconds_since(begin);
    if (options.json)
        write_report(*options.json, report_json(options, settings, isa, scene, result.statistics, times));
    if (result.finished_fraction == 1) return 0;
    if (!options.quiet)
        fmt::print(stderr, "stopped after {:.1f} % of the pixels\n", 100 * result.finished_fraction);
    return kInterruptedExitCode;
}

} // namespace nusselt::app
