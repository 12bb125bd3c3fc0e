#include "lab/tubes/light_costs.h"

#include "base/isa.h"
#include "lab/tubes/rectangle.h"
#include "lab/tubes/tube_settings.h"
#include "proof/median.h"
#include "proof/quantile.h"
#include "render/film.h"
#include "render_cpu/renderer.h"
#include "scene/import/importers.h"

#include <fmt/format.h>

#include <deque>
#include <stdexcept>
#include <utility>

namespace nusselt::lab {

namespace {

using scene::LineLight;
using scene::TubeModel;

constexpr const char* kLine = "line";
constexpr const char* kStrip = "line with a normal";
constexpr const char* kOpenTube = "tube without caps";
constexpr const char* kTube = "tube with caps";
constexpr const char* kQuad = "quad";

/// Copies of the light of the scene, one beside the other, in this model.
scene::Scene with_copies(scene::Scene scene, int count, TubeModel model) {
    auto& lights = scene.lights.of<LineLight>();
    if (lights.size() != 1) throw std::runtime_error("the scene of light costs must have one line");
    lights[0].model = model;
    for (int i = 1; i < count; ++i) {
        LineLight light = lights[0];
        const float shift = 0.01f * static_cast<float>(i);
        light.start.z -= shift;
        light.end.z -= shift;
        lights.push_back(light);
    }
    return scene;
}

scene::Scene with_quads(const scene::Scene& scene, int count) {
    scene::Scene quads = with_copies(scene, count, TubeModel::strip);
    for (const LineLight& strip : quads.lights.of<LineLight>())
        quads.lights.of<scene::PolygonLight>().push_back(rectangle_of(strip));
    quads.lights.of<LineLight>().clear();
    return quads;
}

/// A scene and its times.
struct Timed {
    Timed(const char* name, scene::Scene lights)
        : light(name), scene(std::move(lights)), renderer(scene, 1) {}

    /// Time of the shading, for each light and pixel [ns].
    double render(int lights) const {
        const render::RenderResult result = renderer.render(analytic_tubes(), base::choose_isa());
        const double pixels = static_cast<double>(result.image.width) * result.image.height;
        return 1e9 * result.statistics.shading_seconds / (pixels * lights);
    }

    const char* light;
    scene::Scene scene;
    render_cpu::Renderer renderer;
    std::vector<double> times = {};
};

const LightCost& cost_of(const LightCostsResult& result, const std::string& light) {
    for (const LightCost& cost : result.lights)
        if (cost.light == light) return cost;
    throw std::logic_error("nobody measures a " + light);
}

} // namespace

const std::vector<LightCosts>& all_light_costs() {
    static const std::vector<LightCosts> all = {
        {"tube-costs", "Heitz and Hill 2017, Sec. 1.5.4 and 1.7",
         "Cost of analytic shading with lines, tubes with and without caps, and quads, on one thread."}};
    return all;
}

LightCosts quick(LightCosts costs) {
    costs.repetitions = 9;
    return costs;
}

LightCostsResult run_light_costs(const LightCosts& costs, const RunSettings& settings,
                                 const ProgressText& progress) {
    scene::Scene scene = scene::load_scene(settings.scenes / "evidence/tube-over-metal.pbrt");
    render::resize_film_to_width(scene, costs.width);
    std::deque<Timed> all;
    for (const auto& [light, model] :
         {std::pair(kLine, TubeModel::linear), std::pair(kStrip, TubeModel::strip),
          std::pair(kOpenTube, TubeModel::open), std::pair(kTube, TubeModel::solid)})
        all.emplace_back(light, with_copies(scene, costs.lights, model));
    all.emplace_back(kQuad, with_quads(scene, costs.lights));
    progress(fmt::format("{} interleaved repetitions", costs.repetitions));
    for (int i = -1; i < costs.repetitions; ++i)
        for (Timed& timed : all) {
            const double ns = timed.render(costs.lights);
            if (i >= 0) timed.times.push_back(ns); // The first round warms up.
        }
    LightCostsResult result = {costs, {}, scene.files};
    for (const Timed& timed : all) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < timed.times.size(); ++i)
            ratios.push_back(timed.times[i] / all.back().times[i]);
        result.lights.push_back({timed.light, proof::median(timed.times),
                                 proof::half_interquartile_range(timed.times),
                                 proof::median(std::move(ratios))});
    }
    return result;
}

Report report_of(const LightCostsResult& result) {
    Report report;
    report.setting = fmt::format("Times for one light at one shading point of metal, on one thread: medians "
                                 "of {} interleaved repetitions ± half "
                                 "the interquartile range, {} lights. The paper times a shading pass with "
                                 "one light, which does more than that.",
                                 result.costs.repetitions, result.costs.lights);
    report.tables = {{{"light", "ns", "over a quad"}}};
    ResultTable costs = {"costs", {{"light"}, {"ns", "ns"}, {"spread_ns", "ns"}, {"ratio"}}};
    for (const LightCost& cost : result.lights) {
        report.tables[0].push_back({cost.light, fmt::format("{:.3g} ± {:.2g}", cost.ns, cost.spread),
                                    fmt::format("{:.2f}", cost.ratio)});
        costs.rows.push_back({cost.light, cost.ns, cost.spread, cost.ratio});
    }
    const double line = cost_of(result, kLine).ratio;
    const double caps = cost_of(result, kTube).ratio / cost_of(result, kOpenTube).ratio;
    report.expectations = {
        checked(fmt::format("a line is cheaper than a quad: {:.2f} of it", line), line < 1),
        checked(fmt::format("a tube with caps costs more than one without: {:.2f} times as much", caps),
                caps > 1)};
    report.measured = {{"ltc-lines-sec-1.7-cost", "line without caps, over quad", line}};
    report.numbers = {result.costs.name,
                      {{"lights", std::int64_t(result.costs.lights)},
                       {"repetitions", std::int64_t(result.costs.repetitions)}},
                      {std::move(costs)}};
    report.inputs = result.files;
    return report;
}

} // namespace nusselt::lab
