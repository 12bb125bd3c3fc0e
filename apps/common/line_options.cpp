#include "line_options.h"

#include "help.h"
#include "render_setup.h"
#include "validators.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace nusselt::app {

void add_line_kind_options(CLI::App& command, LineKindOptions& options) {
    const render::LineSettings defaults;
    const auto add = [&command](const char* name, std::optional<std::string>& value,
                                const char* description) {
        return command.add_option(name, value, description)->group(kLinesGroup);
    };
    add("--orientation", options.orientation,
        "Directions of lines: parallel (random, but the same for all lines of a shading point and a light), "
        "fixed (along the longest edge of the light) or independent")
        ->transform(to_one_of(names_of(render::kLineOrientations)))
        ->default_str(std::string(name_of(defaults.orientation)));
    add("--offsets", options.offsets,
        "Density of lines: length (proportional to their length on the light), uniform, or reflected "
        "(proportional to what the surface would reflect of them without shadows)")
        ->transform(to_one_of(names_of(render::kLineOffsets)))
        ->default_str(std::string(name_of(defaults.offsets)));
    add("--line-shading", options.shading,
        "How lines are shaded: unbiased (the integral of a linearly transformed cosine over the visible "
        "parts of a line, plus one point for the difference from the BRDF) or analytic (the integral alone). "
        "Both are exact for matte and Phong surfaces")
        ->transform(to_one_of(names_of(render::kLineShadings)))
        ->default_str(std::string(name_of(defaults.shading)));
}

void add_line_options(CLI::App& command, LineOptions& options) {
    const render::LineSettings defaults;
    CLI::Option* const light_samples = command
                                           .add_option("--light-samples", options.light_samples,
                                                       "How polygonal lights are sampled: by points, or by "
                                                       "lines with exact visibility. Spheres, disks, "
                                                       "tubes and linear lights always get --spp points")
                                           ->transform(to_one_of(names_of(render::kLightSamples)))
                                           ->group(kLinesGroup);
    constexpr const char* kHidden = "";
    command
        .add_option_function<std::string>("--integrator",
                                          [&options](const std::string& name) {
                                              options.light_samples = name;
                                              options.has_old_name = true;
                                          })
        ->transform(to_one_of(names_of(render::kLightSamples)))
        ->excludes(light_samples)
        ->group(kHidden);
    command
        .add_option("--lines", options.count,
                    "Lines per shading point and polygon of a light; use 16 or more")
        ->transform(to_whole_number(1, render::kMaxLines))
        ->default_str(std::to_string(defaults.count))
        ->group(kLinesGroup);
    add_line_kind_options(command, options);
    command
        .add_option(
            "--many-occluders", options.many_occluders,
            "What to do where many triangles may hide a light, because lines are slow there: points, replace "
            "N lines by points with the given technique, strategies and --mis, as many as the power of two "
            "nearest to N^1.4 (and everywhere with fewer than 16 lines); or lines, keep lines")
        ->transform(to_one_of(names_of(render::kManyOccludersChoices)))
        ->default_str(std::string(name_of(defaults.many_occluders)))
        ->group(kLinesGroup);
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
