#include "common/source_folder.h"
#include "lab/lines/line_convergence.h"

#include "common/results_json.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

namespace nusselt::lab {

namespace {

const std::filesystem::path kScenes = std::filesystem::path(nusselt_test::kSourceFolder) / "scenes";

LineConvergenceResult run(const LineConvergence& experiment) {
    RunSettings settings;
    settings.scenes = kScenes;
    return run_line_convergence(experiment, settings, [](std::string_view) {});
}

TEST(LineConvergence, NamesAreUniqueAndExpectationsReferToSeries) {
    std::set<std::string> names;
    for (const LineConvergence& e : all_line_convergences()) {
        EXPECT_TRUE(names.insert(e.name).second) << e.name;
        std::set<std::string> labels;
        for (const ConvergenceSeries& s : e.series) {
            EXPECT_TRUE(labels.insert(s.label).second) << s.label;
            EXPECT_TRUE(std::is_sorted(s.counts.begin(), s.counts.end())) << s.label;
            EXPECT_NE(std::find(s.counts.begin(), s.counts.end(), s.fit_first), s.counts.end()) << s.label;
            EXPECT_NE(std::find(s.counts.begin(), s.counts.end(), s.fit_last), s.counts.end()) << s.label;
        }
        EXPECT_EQ(labels.count(e.reference), 1u) << e.reference;
        for (const OrderBetween& o : e.orders) EXPECT_EQ(labels.count(o.series), 1u) << o.series;
        for (const LessNoise& l : e.less_noise) {
            EXPECT_EQ(labels.count(l.series), 1u) << l.series;
            EXPECT_EQ(labels.count(l.than), 1u) << l.than;
        }
        for (const LessTime& l : e.less_time) EXPECT_EQ(labels.count(l.series) + labels.count(l.than), 2u);
        for (const SameOrder& o : e.same_orders) EXPECT_EQ(labels.count(o.series) + labels.count(o.as), 2u);
        for (const LineScene& s : e.scenes)
            if (s.origin == SceneOrigin::shipped) {
                EXPECT_TRUE(std::filesystem::exists(kScenes / s.file)) << s.file;
                EXPECT_TRUE(s.rig.empty() || std::filesystem::exists(kScenes / "rigs" / s.rig)) << s.rig;
            }
    }
}

TEST(LineConvergence, ExpectationsHoldInSmallImages) {
    for (const LineConvergence& full : all_line_convergences()) {
        const LineConvergence experiment = quick(full);
        const LineConvergenceResult result = run(experiment);
        ASSERT_EQ(result.scenes.size(), 1u);
        EXPECT_GT(result.scenes[0].mean, 0);
        for (const ExpectationResult& e : result.expectations) EXPECT_EQ(e.verdict, Verdict::holds) << e.text;
        // Matt surfaces: closed forms are exact.
        for (std::size_t i = 0; i < experiment.series.size(); ++i)
            EXPECT_NEAR(result.scenes[0].series[i].bias, 0, 5e-3) << experiment.series[i].label;
    }
}

// Points posing as lines have the order of points, lines posing as points that of lines.
TEST(LineConvergence, ExpectationsFailForImpostors) {
    LineConvergence mutant = quick(all_line_convergences()[0]);
    const auto settings_of = [&](const std::string& label) -> render::RenderSettings& {
        return std::find_if(mutant.series.begin(), mutant.series.end(),
                            [&](const ConvergenceSeries& s) { return s.label == label; })
            ->settings;
    };
    std::swap(settings_of("points, stratified"), settings_of("lines, stratified"));
    settings_of("lines, independent").sample_order = render::SampleOrder::stratified;
    for (const std::string series : {"points, stratified", "lines, stratified", "lines, independent"}) {
        LineConvergence one = mutant;
        std::erase_if(one.series, [&](const ConvergenceSeries& s) { return s.label != series; });
        one.reference = series;
        std::erase_if(one.orders, [&](const OrderBetween& e) { return e.series != series; });
        one.less_noise.clear();
        one.less_time.clear();
        one.same_orders.clear();
        const LineConvergenceResult result = run(one);
        ASSERT_EQ(result.expectations.size(), 1u) << series;
        EXPECT_EQ(result.expectations[0].verdict, Verdict::fails) << result.expectations[0].text;
    }
}

/// Results of a scene whose series all have this order.
SceneResult scene_of_order(const LineConvergence& experiment, double order) {
    SceneResult scene;
    scene.series.resize(experiment.series.size());
    for (SeriesResult& s : scene.series) s.order = order;
    return scene;
}

TEST(LineConvergence, CountsExceptionsAndLeavesOutSkippedScenes) {
    LineConvergence experiment = all_line_convergences()[0];
    experiment.less_noise.clear();
    experiment.less_time.clear();
    experiment.same_orders.clear();
    experiment.orders = {{"lines, stratified", -2, -1.1, 1}};
    SceneResult skipped;
    skipped.is_skipped = true;
    std::vector<SceneResult> scenes = {scene_of_order(experiment, -1.2), scene_of_order(experiment, -0.7),
                                       scene_of_order(experiment, -1.1), skipped};
    EXPECT_EQ(check_expectations(experiment, scenes)[0].verdict, Verdict::holds);
    scenes[0] = scene_of_order(experiment, std::nan(""));
    EXPECT_EQ(check_expectations(experiment, scenes)[0].verdict, Verdict::fails);
    // Two scenes with an exception are not conclusive.
    scenes.pop_back();
    scenes[1].is_skipped = true;
    EXPECT_EQ(check_expectations(experiment, scenes)[0].verdict, Verdict::not_evaluated);
    experiment.orders[0].series = "no such series";
    EXPECT_THROW(check_expectations(experiment, scenes), std::logic_error);
}

TEST(LineConvergence, ComparesTimesToTheSameError_AndOrders) {
    LineConvergence experiment = all_line_convergences()[0];
    experiment.orders.clear();
    experiment.less_noise.clear();
    const std::string first = experiment.series[0].label;
    const std::string second = experiment.series[1].label;
    experiment.less_time = {{first, second, 64}};
    experiment.same_orders = {{first, second, 0.1}};
    SceneResult scene = scene_of_order(experiment, -1);
    scene.series[0].curve = {{64, 1, 3, 16, 0}};
    scene.series[1].curve = {{64, 2, 2, 16, 0}};
    scene.series[1].order = -1.05;
    for (const ExpectationResult& e : check_expectations(experiment, {scene}))
        EXPECT_EQ(e.verdict, Verdict::holds) << e.text;
    scene.series[0].curve[0].seconds = 5;
    scene.series[1].order = -0.85;
    for (const ExpectationResult& e : check_expectations(experiment, {scene}))
        EXPECT_EQ(e.verdict, Verdict::fails) << e.text;
}

TEST(LineConvergence, FewSamplesGetMoreSeeds) {
    const LineConvergence& experiment = all_line_convergences()[0];
    EXPECT_EQ(seeds_for(experiment, 1024), experiment.seeds);
    EXPECT_EQ(seeds_for(experiment, 1), experiment.most_seeds);
    EXPECT_EQ(seeds_for(experiment, 16), 64);
}

TEST(LineReport, HasPlotsTablesAndAllNumbers) {
    LineConvergence experiment = quick(all_line_convergences()[0]);
    experiment.reference = experiment.series[1].label;
    experiment.scenes.push_back({"elsewhere", "nowhere.pbrt", "", SceneOrigin::published});
    experiment.series.resize(2);
    experiment.orders = {{experiment.series[0].label, -0.6, -0.4}};
    experiment.less_noise.clear();
    experiment.less_time.clear();
    experiment.same_orders.clear();
    const char* const published = std::getenv("NUSSELT_SCENES");
    const std::string before = published == nullptr ? "" : published;
    ::unsetenv("NUSSELT_SCENES");
    const LineConvergenceResult result = run(experiment);
    if (published != nullptr) ::setenv("NUSSELT_SCENES", before.c_str(), 1);
    EXPECT_TRUE(result.scenes[1].is_skipped);
    EXPECT_NE(to_text(report_of(result)).find("skipped"), std::string::npos);

    const Report report = report_of(result);
    ASSERT_EQ(report.plots.size(), 2u);
    EXPECT_EQ(report.plots[0].file, "grid-planes-samples");
    EXPECT_EQ(report.plots[1].file, "grid-planes-time");
    for (const Plot& plot : report.plots) {
        ASSERT_EQ(plot.curves.size(), 2u);
        for (const PlotPoint& p : plot.curves[0].points) {
            EXPECT_LT(p.low, p.y);
            EXPECT_GT(p.high, p.y);
            EXPECT_LT(p.high, 2 * p.y);
        }
    }
    const auto numbers = nlohmann::json::parse(to_json(report.numbers));
    const auto scenes = nusselt_test::records(numbers, "scenes");
    EXPECT_EQ(scenes[1]["skipped"], true);
    EXPECT_GT(scenes[0]["reference_error"], 0);
    const auto series = nusselt_test::records(numbers, "series");
    ASSERT_EQ(series.size(), 2u);
    EXPECT_EQ(series[1]["bias"], 0);
    ASSERT_EQ(report.measured.size(), 2u);
    EXPECT_EQ(report.measured[0].item, "line-samples-fig-9");
    EXPECT_EQ(report.measured[0].quantity, "Grid planes: points, random");
    const auto curves = nusselt_test::records(numbers, "curves");
    ASSERT_EQ(curves.size(), 10u);
    EXPECT_EQ(curves[5]["series"], series[1]["series"]);
    EXPECT_EQ(curves[5]["count"], 4);
    EXPECT_EQ(curves[5]["seeds"], 32);
    EXPECT_EQ(curves[9]["seeds"], 16);
}

} // namespace

} // namespace nusselt::lab
