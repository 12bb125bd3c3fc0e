#include "base/temporary_folder.h"
#include "common/source_folder.h"
#include "lab/lines/line_convergence.h"

#include "common/results_json.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

namespace nusselt::lab {

namespace {

const std::filesystem::path kScenes = std::filesystem::path(nusselt_test::kSourceFolder) / "scenes";

/// The experiment without slow counts and scenes. The first scene is no exception to anything.
LineConvergence small(const LineConvergence& full) {
    LineConvergence experiment = full;
    experiment.scenes.resize(1);
    experiment.width = 32;
    experiment.most_seeds = 32;
    for (ConvergenceSeries& series : experiment.series) {
        const auto is_long = [](int n) { return n > 64; };
        series.counts.erase(std::remove_if(series.counts.begin(), series.counts.end(), is_long),
                            series.counts.end());
        series.fit_first = 4;
        series.fit_last = 64;
    }
    for (OrderBetween& e : experiment.orders) e.exceptions = 0;
    for (LessNoise& e : experiment.less_noise) {
        e.count = 64;
        e.exceptions = 0;
    }
    return experiment;
}

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
        for (const LineScene& s : e.scenes)
            if (s.origin == SceneOrigin::shipped) {
                EXPECT_TRUE(std::filesystem::exists(kScenes / s.file)) << s.file;
                EXPECT_TRUE(s.rig.empty() || std::filesystem::exists(kScenes / "rigs" / s.rig)) << s.rig;
            }
    }
}

TEST(LineConvergence, ExpectationsHoldInSmallImages) {
    for (const LineConvergence& full : all_line_convergences()) {
        const LineConvergence experiment = small(full);
        const LineConvergenceResult result = run(experiment);
        ASSERT_EQ(result.scenes.size(), 1u);
        EXPECT_GT(result.scenes[0].mean, 0);
        for (const ExpectationResult& e : result.expectations) EXPECT_TRUE(e.holds) << e.text;
        // Matt surfaces: closed forms are exact.
        for (std::size_t i = 0; i < experiment.series.size(); ++i)
            EXPECT_NEAR(result.scenes[0].series[i].bias, 0, 5e-3) << experiment.series[i].label;
    }
}

// Points posing as lines have the order of points, lines posing as points that of lines.
TEST(LineConvergence, ExpectationsFailForImpostors) {
    LineConvergence mutant = small(all_line_convergences()[0]);
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
        const LineConvergenceResult result = run(one);
        ASSERT_EQ(result.expectations.size(), 1u) << series;
        EXPECT_FALSE(result.expectations[0].holds) << result.expectations[0].text;
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
    experiment.orders = {{"lines, stratified", -2, -1.1, 1}};
    SceneResult skipped;
    skipped.is_skipped = true;
    std::vector<SceneResult> scenes = {scene_of_order(experiment, -1.2), scene_of_order(experiment, -0.7),
                                       scene_of_order(experiment, -1.1), skipped};
    EXPECT_TRUE(check_expectations(experiment, scenes)[0].holds);
    scenes[0] = scene_of_order(experiment, std::nan(""));
    EXPECT_FALSE(check_expectations(experiment, scenes)[0].holds);
    // Two scenes with an exception are not conclusive.
    scenes.pop_back();
    scenes[1].is_skipped = true;
    EXPECT_TRUE(check_expectations(experiment, scenes).empty());
    experiment.orders[0].series = "no such series";
    EXPECT_THROW(check_expectations(experiment, scenes), std::logic_error);
}

TEST(LineConvergence, FewSamplesGetMoreSeeds) {
    const LineConvergence& experiment = all_line_convergences()[0];
    EXPECT_EQ(seeds_for(experiment, 1024), experiment.seeds);
    EXPECT_EQ(seeds_for(experiment, 1), experiment.most_seeds);
    EXPECT_EQ(seeds_for(experiment, 16), 64);
}

TEST(LineReport, HasPlotsTablesAndAllNumbers) {
    LineConvergence experiment = small(all_line_convergences()[0]);
    experiment.reference = experiment.series[1].label;
    experiment.scenes.push_back({"elsewhere", "nowhere.pbrt", "", SceneOrigin::published});
    experiment.series.resize(2);
    experiment.orders = {{experiment.series[0].label, -0.6, -0.4}};
    experiment.less_noise.clear();
    const char* const published = std::getenv("NUSSELT_SCENES");
    const std::string before = published == nullptr ? "" : published;
    ::unsetenv("NUSSELT_SCENES");
    const LineConvergenceResult result = run(experiment);
    if (published != nullptr) ::setenv("NUSSELT_SCENES", before.c_str(), 1);
    EXPECT_TRUE(result.scenes[1].is_skipped);
    EXPECT_NE(to_text(result).find("skipped"), std::string::npos);

    const nusselt::base::TemporaryFolder folder;
    write_report(result, folder.path());
    std::ifstream page(folder / "index.html");
    const std::string html{std::istreambuf_iterator<char>(page), {}};
    for (const char* plot : {"grid-planes-samples.svg", "grid-planes-time.svg"}) {
        EXPECT_NE(html.find(plot), std::string::npos);
        EXPECT_GT(std::filesystem::file_size(folder / plot), 1000u);
    }
    std::ifstream file(folder / "numbers.json");
    const auto numbers = nlohmann::json::parse(file);
    const auto scenes = nusselt_test::records(numbers, "scenes");
    EXPECT_EQ(scenes[1]["skipped"], true);
    EXPECT_GT(scenes[0]["reference_error"], 0);
    const auto series = nusselt_test::records(numbers, "series");
    ASSERT_EQ(series.size(), 2u);
    EXPECT_EQ(series[1]["bias"], 0);
    const auto curves = nusselt_test::records(numbers, "curves");
    ASSERT_EQ(curves.size(), 10u);
    EXPECT_EQ(curves[5]["series"], series[1]["series"]);
    EXPECT_EQ(curves[5]["count"], 4);
    EXPECT_EQ(curves[5]["seeds"], 32);
    EXPECT_EQ(curves[9]["seeds"], 16);
}

} // namespace

} // namespace nusselt::lab
