#include "lab/lines/line_visibility.h"

#include <fmt/format.h>

#include <algorithm>
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
            256};
}

LineVisibility table() {
    LineVisibility experiment = {
        "lines-visibility",
        "Billen and Dutre 2016, Table 1",
        "Tests of boxes and triangles against what lines span with their shading points.",
        in_both_lights(),
        {},
        64,
        256};
    for (const LineScene& scene : scenes_with_large_lights())
        for (const auto work : {&WorkPerLine::box_tests, &WorkPerLine::triangle_tests})
            experiment.expectations.push_back({work, scene.name + ", large", scene.name + ", small"});
    return experiment;
}

RenderSettings settings_of(const LineVisibility& experiment) {
    RenderSettings settings;
    settings.light_samples = render::LightSamples::lines;
    settings.lines.count = experiment.lines;
    settings.lines.shading = render::LineShading::analytic;
    settings.lines.many_occluders = render::ManyOccluders::lines;
    settings.sample_order = render::SampleOrder::stratified;
    settings.pixel_position = render::PixelPosition::center;
    settings.layers = {render::LayerKind::pieces};
    return settings;
}

WorkPerLine work_of(const LineStatistics& statistics) {
    const auto lines = static_cast<double>(std::max<std::uint64_t>(statistics.lines, 1));
    return {static_cast<double>(statistics.parts) / lines, static_cast<double>(statistics.box_tests) / lines,
            static_cast<double>(statistics.triangle_tests) / lines};
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
    return result;
}

const LineVisibilityScene& find(const std::vector<LineVisibilityScene>& scenes, const std::string& name) {
    const auto found = std::find_if(scenes.begin(), scenes.end(),
                                    [&](const LineVisibilityScene& s) { return s.scene == name; });
    if (found == scenes.end())
        throw std::logic_error("an expectation names " + name + ", which is not rendered");
    return *found;
}

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
        const std::string text =
            fmt::format("more {} per line in '{}' than in '{}'", name_of(e.work), e.scene, e.than);
        if (more.is_skipped || less.is_skipped)
            results.push_back(not_evaluated(text, "a scene was skipped"));
        else
            results.push_back(checked(text, more.work.*e.work > less.work.*e.work));
    }
    return results;
}

} // namespace nusselt::lab
