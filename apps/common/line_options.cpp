#include "line_options.h"

#include "render_setup.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace nusselt::app {

namespace {

constexpr const char* kGroup = "Line samples";

} // namespace

void add_line_kind_options(CLI::App& command, LineKindOptions& options) {
    command
        .add_option(
            "--orientation", options.orientation,
            "Directions of lines: parallel (random, but the same for all lines of a shading point and a\n"
            "light), fixed (along the longest edge of the light) or independent. Default: parallel")
        ->transform(to_name_of(render::kLineOrientations))
        ->group(kGroup);
    command
        .add_option(
            "--offsets", options.offsets,
            "Density of lines: length (proportional to their length on the light), uniform, or reflected\n"
            "(proportional to what the surface would reflect of them without shadows). Default: reflected")
        ->transform(to_name_of(render::kLineOffsets))
        ->group(kGroup);
    command
        .add_option(
            "--line-shading", options.shading,
            "unbiased: the integral of a linearly transformed cosine over the visible parts of a line,\n"
            "plus one point for the difference from the BRDF; analytic: the integral alone.\n"
            "Default: unbiased")
        ->transform(to_name_of(render::kLineShadings))
        ->group(kGroup);
}

void add_line_options(CLI::App& command, LineOptions& options) {
    CLI::Option* const light_samples =
        command
            .add_option(
                "--light-samples", options.light_samples,
                "How polygonal lights are sampled: by points, or by lines with exact visibility. Tubes and\n"
                "linear lights always get --spp points")
            ->transform(to_name_of(render::kLightSamples))
            ->capture_default_str()
            ->group(kGroup);
    constexpr const char* kHidden = "";
    command
        .add_option_function<std::string>("--integrator",
                                          [&options](const std::string& name) {
                                              options.light_samples = name;
                                              options.has_old_name = true;
                                          })
        ->transform(to_name_of(render::kLightSamples))
        ->excludes(light_samples)
        ->group(kHidden);
    command
        .add_option(
            "--lines", options.count,
            fmt::format(
                "Lines per shading point and polygon of a light, 1 to {}; use 16 or more. Default: {}",
                render::kMaxLines, render::LineSettings().count))
        ->check(CLI::Range(1, render::kMaxLines))
        ->group(kGroup);
    add_line_kind_options(command, options);
    command
        .add_option(
            "--many-occluders", options.many_occluders,
            "What shading points use where many triangles may hide a light: points, faster there than\n"
            "N lines (for fewer than 16 lines everywhere), as many as the power of two next to N^1.4,\n"
            "with the given technique and strategies; or lines nevertheless. Default: points")
        ->transform(to_name_of(render::kManyOccludersChoices))
        ->group(kGroup);
}

void apply_line_kind_options(const LineKindOptions& options, render::LineSettings& settings) {
    if (options.orientation)
        settings.orientation = from_name(render::kLineOrientations, *options.orientation);
    if (options.offsets) settings.offsets = from_name(render::kLineOffsets, *options.offsets);
    if (options.shading) settings.shading = from_name(render::kLineShadings, *options.shading);
}

void apply_line_options(const LineOptions& options, render::RenderSettings& settings) {
    settings.light_samples = from_name(render::kLightSamples, options.light_samples);
    render::LineSettings& lines = settings.lines;
    if (options.count) lines.count = *options.count;
    apply_line_kind_options(options, lines);
    if (options.many_occluders)
        lines.many_occluders = from_name(render::kManyOccludersChoices, *options.many_occluders);
}

nlohmann::ordered_json line_kind_json(const render::LineSettings& settings) {
    return {{"orientation", render::name_of(settings.orientation)},
            {"offsets", render::name_of(settings.offsets)},
            {"line_shading", render::name_of(settings.shading)}};
}

} // namespace nusselt::app
