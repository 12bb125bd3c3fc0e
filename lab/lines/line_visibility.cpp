#include "lab/lines/line_visibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using render::LineStatistics;
using render::RenderSettings;

std::vector<LineScene> in_both_lights() {
    std::vector<LineScene> scenes;
    const std::vector<LineScene> large = scenes_with_large_lights();
    const std::vector<LineScene> small = scenes_with_small_lights();
    for (std::size_t i = 0; i < large.size(); ++i) {
        scenes.push_back(small[i]);
        scenes.back().name += ", small";
        scenes.push_back(large[i]);
        scenes.back().name += ", large";
    }
    return scenes;
}

LineVisibility visible_parts() {
    std::vector<LineScene> scenes = scenes_with_large_lights();
    const auto is_other = [](const LineScene& s) { return s.name != "soup" && s.name != "sponza"; };
    scenes.erase(std::remove_if(scenes.begin(), scenes.end(), is_other), scenes.end());
    return {"lines-pieces",
            "Billen and Dutre 2016, Fig. 5",
            "Into how many visible parts occluders cut a line, for each pixel.",
            scenes,
            {{&WorkPerLine::parts, "soup", "sponza"}},
            64,
            256,
            8,
            ""};
}

LineVisibility table() {
    LineVisibility experiment = {"lines-visibility",
                                 "Billen and Dutre 2016, Table 1",
                                 "Tests of boxes and triangles against what lines span with their shading "
                                 "points, for all lines of a point "
                                 "together and, as in the paper, for each line by itself.",
                                 in_both_lights(),
                                 {},
                                 1024,
                                 256,
                                 8,
                                 "line-samples-table-1"};
    for (const LineScene& scene : scenes_with_large_lights())
        for (const auto work : {&WorkPerLine::box_tests, &WorkPerLine::triangle_tests})
            experiment.expectations.push_back({work, scene.name + ", large", scene.name + ", small"});
    return experiment;
}

RenderSettings settings_of(const LineVisibility& experiment) {
    RenderSettings settings = settings_of_lines_together(experiment.lines);
    settings.lines.shading = render::LineShading::analytic;
    settings.layers = {render::LayerKind::pieces};
    return settings;
}

WorkPerLine work_of(const LineStatistics& statistics) {
    const auto lines = static_cast<double>(std::max<std::uint64_t>(statistics.lines, 1));
    return {static_cast<double>(statistics.parts) / lines, static_cast<double>(statistics.box_tests) / lines,
            static_cast<double>(statistics.triangle_tests) / lines};
}

WorkPerLine work_of(const LineCounts& counts) {
    const auto lines = static_cast<double>(std::max<std::uint64_t>(counts.lines, 1));
    return {static_cast<double>(counts.parts) / lines, static_cast<double>(counts.box_tests) / lines,
            static_cast<double>(counts.triangle_tests) / lines};
}

void trace_one_by_one(const LineVisibility& experiment, const scene::Scene& scene,
                      const render_cpu::Renderer& renderer, int threads, LineVisibilityScene& result) {
    const std::vector<LinePoint> points = line_points(scene, renderer, experiment.step);
    const std::vector<LineByLineWork> work = trace_line_by_line(scene, points, experiment.lines, threads);
    double parts = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        result.one_by_one += work[i];
        parts += static_cast<double>(work[i].counts.lines) * result.parts.values[points[i].pixel];
    }
    result.work_one_by_one = work_of(result.one_by_one.counts);
    result.parts_together =
        parts / static_cast<double>(std::max<std::uint64_t>(result.one_by_one.counts.lines, 1));
}

LineVisibilityScene run_scene(const LineVisibility& experiment, const std::string& name,
                              const scene::Scene& scene, int threads) {
    const render_cpu::Renderer renderer(scene, threads);
    render::RenderResult rendered = renderer.render(settings_of(experiment), base::choose_isa());
    LineVisibilityScene result;
    result.scene = name;
    result.files = scene.files;
    result.statistics = rendered.statistics;
    result.work = work_of(rendered.statistics.lines);
    for (const image::Layer& layer : rendered.layers)
        if (layer.name == "pieces")
            result.parts = {
                rendered.image.width, rendered.image.height, {layer.data.begin(), layer.data.end()}};
    result.image = std::move(rendered.image);
    trace_one_by_one(experiment, scene, renderer, threads, result);
    return result;
}

const LineVisibilityScene& find(const std::vector<LineVisibilityScene>& scenes, const std::string& name) {
    const auto found = std::find_if(scenes.begin(), scenes.end(),
                                    [&](const LineVisibilityScene& s) { return s.scene == name; });
    if (found == scenes.end())
        throw std::logic_error("an expectation names " + name + ", which is not rendered");
    return *found;
}

/// Directions of lines are random, and different for both.
constexpr double kLargestDifference = 0.05;

const char* name_of(double WorkPerLine::*work) {
    if (work == &WorkPerLine::parts) return "visible parts";
    return work == &WorkPerLine::box_tests ? "tests of boxes" : "tests of triangles";
}

} // namespace

const std::vector<LineVisibility>& all_line_visibilities() {
    static const std::vector<LineVisibility> experiments = {visible_parts(), table()};
    return experiments;
}

LineVisibility quick(LineVisibility experiment) {
    experiment.width = 96;
    experiment.lines = 8;
    experiment.step = 4;
    return experiment;
}

LineVisibilityResult run_line_visibility(const LineVisibility& experiment, const RunSettings& settings,
                                         const ProgressText& progress) {
    LineVisibilityResult result;
    result.experiment = &experiment;
    result.width = experiment.width;
    const int threads = thread_count(settings);
    result.scenes =
        for_each_scene<LineVisibilityScene>(experiment.scenes, settings, result.width, progress,
                                            [&](const LineScene& line_scene, const scene::Scene& scene) {
                                                progress(line_scene.name);
                                                return run_scene(experiment, line_scene.name, scene, threads);
                                            });
    result.expectations = check_expectations(experiment, result.scenes);
    return result;
}

std::vector<ExpectationResult> check_expectations(const LineVisibility& experiment,
                                                  const std::vector<LineVisibilityScene>& scenes) {
    std::vector<ExpectationResult> results;
    for (const MoreWork& e : experiment.expectations) {
        const LineVisibilityScene& more = find(scenes, e.scene);
        const LineVisibilityScene& less = find(scenes, e.than);
        const std::string text = fmt::format("more {} per line in '{}' than in '{}', together and one by one",
                                             name_of(e.work), e.scene, e.than);
        if (more.is_skipped || less.is_skipped)
            results.push_back(not_evaluated(text, "a scene was skipped"));
        else
            results.push_back(checked(text, more.work.*e.work > less.work.*e.work &&
                                                more.work_one_by_one.*e.work > less.work_one_by_one.*e.work));
    }
    for (const LineVisibilityScene& scene : scenes) {
        const std::string text =
            fmt::format("in '{}', both ways find as many visible parts per line, within {:.0f} %",
                        scene.scene, 100 * kLargestDifference);
        const double one_by_one = scene.work_one_by_one.parts, together = scene.parts_together;
        if (scene.is_skipped)
            results.push_back(not_evaluated(text, "the scene was skipped"));
        else
            results.push_back(checked(fmt::format("{}: {:.3f} and {:.3f}", text, one_by_one, together),
                                      std::fabs(one_by_one - together) <= kLargestDifference * together));
    }
    return results;
}

} // namespace nusselt::lab
