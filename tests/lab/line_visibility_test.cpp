#include "common/source_folder.h"
#include "lab/lines/line_visibility.h"

#include "common/results_json.h"
#include "published_names.h"
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <stdexcept>

namespace nusselt::lab {

namespace {

/// The quick experiment without the published scenes.
LineVisibility shipped_only(const LineVisibility& full) {
    LineVisibility experiment = quick(full);
    const auto is_published = [](const LineScene& s) { return s.origin == SceneOrigin::published; };
    experiment.scenes.erase(std::remove_if(experiment.scenes.begin(), experiment.scenes.end(), is_published),
                            experiment.scenes.end());
    const auto mentions_sponza = [](const MoreWork& e) {
        return e.scene.find("sponza") != std::string::npos || e.than.find("sponza") != std::string::npos;
    };
    experiment.expectations.erase(
        std::remove_if(experiment.expectations.begin(), experiment.expectations.end(), mentions_sponza),
        experiment.expectations.end());
    return experiment;
}

LineVisibilityResult run(const LineVisibility& experiment) {
    RunSettings settings;
    settings.scenes = std::filesystem::path(nusselt_test::kSourceFolder) / "scenes";
    return run_line_visibility(experiment, settings, [](std::string_view) {});
}

TEST(LineVisibility, NamesAreUniqueAndExpectationsAreAboutScenes) {
    std::set<std::string> names;
    for (const LineVisibility& experiment : all_line_visibilities()) {
        EXPECT_TRUE(names.insert(experiment.name).second) << experiment.name;
        EXPECT_FALSE(experiment.expectations.empty()) << experiment.name;
        std::set<std::string> scenes;
        for (const LineScene& s : experiment.scenes) EXPECT_TRUE(scenes.insert(s.name).second) << s.name;
        for (const MoreWork& e : experiment.expectations) {
            EXPECT_EQ(scenes.count(e.scene), 1u) << e.scene;
            EXPECT_EQ(scenes.count(e.than), 1u) << e.than;
        }
    }
}

TEST(LineVisibility, LargeLightsAreMoreWork) {
    for (const LineVisibility& full : all_line_visibilities()) {
        const LineVisibilityResult result = run(shipped_only(full));
        for (const ExpectationResult& e : result.expectations) EXPECT_EQ(e.verdict, Verdict::holds) << e.text;
        for (const LineVisibilityScene& scene : result.scenes) {
            EXPECT_GT(scene.work.box_tests, 0) << scene.scene;
            // Means over pixels agree with the sum over all lines: each pixel with light has as many of these.
            ASSERT_FALSE(scene.parts.values.empty()) << scene.scene;
            const double largest = *std::max_element(scene.parts.values.begin(), scene.parts.values.end());
            EXPECT_GE(largest, scene.work.parts) << scene.scene;
            EXPECT_GE(largest, 1) << scene.scene;
        }
    }
}

TEST(LineVisibility, ExpectationsCanFailAndAreNotEvaluatedWhereASceneWasSkipped) {
    LineVisibility experiment = all_line_visibilities()[0];
    experiment.expectations = {{&WorkPerLine::parts, "a", "b"}, {&WorkPerLine::parts, "b", "a"}};
    std::vector<LineVisibilityScene> scenes(2);
    scenes[0].scene = "a";
    scenes[1].scene = "b";
    scenes[0].work.parts = scenes[0].work_one_by_one.parts = 2;
    scenes[1].work.parts = scenes[1].work_one_by_one.parts = 1;
    scenes[0].parts_together = 2.05;
    scenes[1].parts_together = 1.1;
    const auto results = check_expectations(experiment, scenes);
    ASSERT_EQ(results.size(), 4u);
    EXPECT_EQ(results[0].verdict, Verdict::holds);
    EXPECT_EQ(results[1].verdict, Verdict::fails);
    EXPECT_EQ(results[2].verdict, Verdict::holds) << "about as many parts";
    EXPECT_EQ(results[3].verdict, Verdict::fails) << "fewer parts";
    // Both ways to trace lines must agree about which scene is more work.
    scenes[0].work_one_by_one.parts = 1;
    EXPECT_EQ(check_expectations(experiment, scenes)[0].verdict, Verdict::fails);
    scenes[0].is_skipped = scenes[1].is_skipped = true;
    for (const ExpectationResult& e : check_expectations(experiment, scenes))
        EXPECT_EQ(e.verdict, Verdict::not_evaluated) << e.text;
    scenes.pop_back();
    EXPECT_THROW(check_expectations(experiment, scenes), std::logic_error);
}

TEST(LineVisibility, NumbersStandBesideThoseOfTheTable) {
    const LineVisibility experiment = shipped_only(all_line_visibilities()[1]);
    const Report report = report_of(run(experiment));
    EXPECT_EQ(report.measured.size(), 5 * experiment.scenes.size() + 1);
    expect_names_of_published_numbers(report);
    EXPECT_TRUE(report_of(run(shipped_only(all_line_visibilities()[0]))).measured.empty());
}

TEST(LineVisibility, ReportHasAnImageOfPartsPerScene) {
    LineVisibility experiment = shipped_only(all_line_visibilities()[0]);
    experiment.scenes.push_back({"soup, small", "soup.pbrt", "small-light.json"});
    const LineVisibilityResult result = run(experiment);
    const Report report = report_of(result);
    ASSERT_EQ(report.images.size(), 2 * experiment.scenes.size());
    for (std::size_t i = 0; i < report.images.size(); i += 2) {
        EXPECT_EQ(report.images[i].role, ImageRole::reference);
        EXPECT_EQ(report.images[i + 1].role, ImageRole::picture);
        EXPECT_EQ(report.images[i + 1].image.width, experiment.width);
    }
    const auto numbers = nlohmann::json::parse(to_json(report.numbers));
    const auto scenes = nusselt_test::records(numbers, "scenes");
    ASSERT_EQ(scenes.size(), experiment.scenes.size());
    EXPECT_GT(scenes[0]["lines"], 0);
    EXPECT_GT(scenes[0]["parts_per_line"], scenes[1]["parts_per_line"]);
}

} // namespace

} // namespace nusselt::lab
