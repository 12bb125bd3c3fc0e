#include "render_settings.h"
#include "apps/common/help.h"
#include "apps/common/line_options.h"
#include "apps/common/print_message.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "render_backend.h"

#include "image/io.h"
#include "render/choices/usual_settings.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nusselt::app {

namespace {

render::Strategies strategies_of(const RenderOptions& options, render::Technique technique,
                                 render::BrdfChoice brdf) {
    if (options.strategies) return from_name(render::kStrategies, *options.strategies);
    return render::usual_strategies(technique, brdf);
}

std::vector<render::LayerKind> layers_of(const std::vector<std::string>& names) {
    std::vector<render::LayerKind> kinds;
    for (const std::string& name : names) {
        if (name == kAllLayers) return {render::kLayerKinds.begin(), render::kLayerKinds.end()};
        kinds.push_back(from_name(render::kLayerKinds, name));
    }
    return kinds;
}

/// Throws CLI::ValidationError if options need data that only EXR files can store, and none is written.
void check_exr_only(const RenderOptions& options) {
    const bool has_exr =
        options.outputs.empty() || std::any_of(options.outputs.begin(), options.outputs.end(), image::is_exr);
    if (has_exr) return;
    for (const auto& [name, is_used] :
         {std::pair("--layers", !options.layers.empty()), std::pair("--part", options.part.has_value())})
        if (is_used) throw CLI::ValidationError(name, "supported only in EXR files; add -o NAME.exr");
}

/// Throws CLI::ValidationError if options for line samples are given without these, or for what these cannot be.
void check_line_options(const RenderOptions& options, render::Technique technique) {
    const LineOptions& lines = options.lines;
    if (from_name(render::kLightSamples, lines.light_samples) == render::LightSamples::lines) {
        if (technique == render::Technique::ltc_analytic)
            throw CLI::ValidationError(
                "--light-samples",
                "lines have shadows, but --technique ltc_analytic has none; use another technique");
        return;
    }
    const auto wants_pieces =
        std::count(options.layers.begin(), options.layers.end(), name_of(render::LayerKind::pieces)) > 0;
    for (const auto& [name, is_given] : {std::pair("--lines", lines.count.has_value()),
                                         std::pair("--orientation", lines.orientation.has_value()),
                                         std::pair("--offsets", lines.offsets.has_value()),
                                         std::pair("--line-shading", lines.shading.has_value()),
                                         std::pair("--many-occluders", lines.many_occluders.has_value()),
                                         std::pair("--layers pieces", wants_pieces)})
        if (is_given) throw CLI::ValidationError(name, "needs --light-samples lines");
}

render::Mis mis_of(const RenderOptions& options, render::Strategies strategies) {
    if (options.mis) return from_name(render::kMisHeuristics, *options.mis);
    return render::usual_mis(strategies);
}

/// \param source what determines the number of samples per pixel
void check_camera_rays(const RenderOptions& options, int samples, const std::string& source) {
    if (options.camera_rays && samples % *options.camera_rays != 0)
        throw CLI::ValidationError("--camera-rays",
                                   fmt::format("{} must divide the {} samples per pixel that {}",
                                               *options.camera_rays, samples, source));
}

} // namespace

void add_sampling_options(CLI::App& command, RenderOptions& options) {
    command
        .add_option("--technique", options.technique,
                    "Technique to sample lights; `nusselt techniques` explains them")
        ->transform(to_one_of(names_of(render::kTechniques)))
        ->group(kSamplingGroup);
    command
        .add_option(
            "--strategies", options.strategies,
            "Which techniques take samples: diffuse, that of --technique alone; diffuse+ltc, that one for "
            "the diffuse component of materials and linearly transformed cosines for the specular component; "
            "diffuse+ggx and diffuse+ggx_bounded, the same with GGX visible normals, for polygons only")
        ->transform(to_one_of(names_of(render::kStrategies)))
        ->default_str(
            "diffuse+ltc with techniques for projected solid angles and --brdf material, else diffuse")
        ->group(kSamplingGroup);
    command
        .add_option("--emission-sampling", options.emission_sampling,
                    "What samples of lights with a texture or a profile, and of portals, are proportional "
                    "to: product, "
                    "radiance times cosine or lobe; measure, that of --technique alone")
        ->transform(to_one_of(names_of(render::kEmissionSamplings)))
        ->default_str(std::string(name_of(render::RenderSettings().emission_sampling)))
        ->group(kSamplingGroup);
    command
        .add_option(
            "--mis", options.mis,
            "How to combine the samples of two techniques: by a heuristic of multiple importance sampling, "
            "by one sample of either technique, or by separate estimates of the components")
        ->transform(to_one_of(names_of(render::kMisHeuristics)))
        ->default_str("clamped_optimal, or balance with GGX visible normals")
        ->group(kSamplingGroup);
    command
        .add_option(
            "--visibility-estimate", options.visibility_estimate,
            "Approximate fraction of the lights that is visible, for --mis clamped_optimal and optimal; "
            "affects only noise")
        ->check(number(0, 1))
        ->default_str(fmt::format("{}", render::RenderSettings().visibility_estimate))
        ->group(kSamplingGroup);
    command
        .add_option(
            "--sampler", options.sampler,
            "How samples are distributed: independent; sobol, Owen-scrambled Sobol' points; jittered, "
            "equidistant points with one random shift, also known as uniform jittered sampling (best for "
            "linear lights); stratified, multi-jittered points with as many strata in each dimension as "
            "samples (best for line samples); z_sobol, Sobol' points for which errors of neighbouring pixels "
            "cancel; blue_noise, jittered points with shifts that differ between neighbouring pixels")
        ->transform(to_one_of(names_of(render::kSampleOrders)))
        ->group(kSamplingGroup);
    command
        .add_option(
            "--brdf", options.brdf,
            "BRDFs: material, those of the materials; or lambert, Lambertian BRDFs with the albedo of the "
            "materials")
        ->transform(to_one_of(names_of(render::kBrdfChoices)))
        ->group(kSamplingGroup);
    command.add_option("--seed", options.seed, "Seed of the random numbers")
        ->transform(to_whole_number(0, std::numeric_limits<std::uint32_t>::max()))
        ->group(kSamplingGroup);
}

render::RenderSettings make_settings(const RenderOptions& options) {
    render::RenderSettings settings;
    settings.technique = from_name(render::kTechniques, options.technique);
    settings.brdf = from_name(render::kBrdfChoices, options.brdf);
    settings.strategies = strategies_of(options, settings.technique, settings.brdf);
    if (options.emission_sampling)
        settings.emission_sampling = from_name(render::kEmissionSamplings, *options.emission_sampling);
    settings.mis = mis_of(options, settings.strategies);
    if (options.visibility_estimate) settings.visibility_estimate = *options.visibility_estimate;
    settings.sample_order = from_name(render::kSampleOrders, options.sampler);
    settings.pixel_position = from_name(render::kPixelPositions, options.pixel_position);
    // Without a number, the scene decides; until then any number will do that fits the camera rays.
    settings.samples = options.samples.value_or(options.camera_rays.value_or(1));
    settings.camera_rays = options.camera_rays;
    settings.seed = options.seed;
    apply_line_options(options.lines, settings);
    settings.layers = layers_of(options.layers);
    if (options.part) settings.part = parse_part(*options.part).value();
    render::validate(settings);
    return settings;
}

void choose_samples(const RenderOptions& options, const scene::Film& film, render::RenderSettings& settings) {
    if (options.samples) return;
    const int asked = film.pixel_samples.value_or(1);
    settings.samples = render::usual_samples(film);
    check_camera_rays(options, settings.samples,
                      film.pixel_samples ? "the Sampler of the scene asks for; --spp changes them"
                                         : "are the default; --spp changes them");
    render::validate(settings);
    if (asked == 1 || options.quiet) return;
    const std::string reason =
        asked == settings.samples
            ? "as the Sampler of the scene asks"
            : fmt::format("the largest number; the Sampler of the scene asks for {}", asked);
    print_message("{} samples per pixel, {}; --spp changes that\n", settings.samples, reason);
}

void check_combination(const RenderOptions& options) {
    const auto technique = from_name(render::kTechniques, options.technique);
    const auto brdf = from_name(render::kBrdfChoices, options.brdf);
    const auto strategies = strategies_of(options, technique, brdf);
    if (!allows(technique, strategies)) {
        std::vector<std::string_view> others;
        for (const auto other : render::kTechniques)
            if (allows(other, strategies)) others.push_back(name_of(other));
        throw CLI::ValidationError("--strategies",
                                   fmt::format("{} needs --technique {}, not {}", name_of(strategies),
                                               fmt::join(others, " or "), options.technique));
    }
    if (strategies == render::Strategies::diffuse && (options.mis || options.visibility_estimate))
        throw CLI::ValidationError(options.mis ? "--mis" : "--visibility-estimate",
                                   "not supported with --strategies diffuse, which combines no samples");
    if (options.mis && !allows(strategies, from_name(render::kMisHeuristics, *options.mis))) {
        std::vector<std::string_view> others;
        for (const auto other : render::kMisHeuristics)
            if (allows(strategies, other)) others.push_back(name_of(other));
        throw CLI::ValidationError("--mis",
                                   fmt::format("{} needs the contribution of each technique without shadows, "
                                               "which is unknown for {}; use {}",
                                               *options.mis, name_of(strategies), fmt::join(others, " or ")));
    }
    if (options.visibility_estimate) {
        const render::Mis mis = mis_of(options, strategies);
        if (!uses_visibility_estimate(mis))
            throw CLI::ValidationError(
                "--visibility-estimate",
                fmt::format("needs --mis clamped_optimal or optimal, not {}", name_of(mis)));
    }
    if (options.samples) check_camera_rays(options, *options.samples, "--spp asks for");
    if (options.checkpoint_interval && !options.checkpoint)
        throw CLI::ValidationError("--checkpoint-interval", "needs --checkpoint");
    check_line_options(options, technique);
    check_backend_options(options);
    check_exr_only(options);
}

} // namespace nusselt::app
