#include "lab/lines/line_growth.h"

#include <gtest/gtest.h>

namespace nusselt::lab {

namespace {

TEST(LineGrowth, IsLogarithmicInTheTrianglesAround) {
    LineGrowth experiment = quick(all_line_growths().front());
    experiment.lines = 8;
    experiment.width = 16;
    const LineGrowthResult result = run_line_growth(experiment, {}, [](std::string_view) {});
    for (const ExpectationResult& e : result.expectations) EXPECT_EQ(e.verdict, Verdict::holds) << e.text;
    const Report report = report_of(result);
    EXPECT_EQ(report.tables.size(), 2u);
    EXPECT_EQ(report.tables[0].size(), experiment.around.size() + 1);
}

/// Work that grows like the number of triangles, or its root, is noticed.
TEST(LineGrowth, FasterGrowthIsNoticed) {
    const auto row = [](int around, int occluders, double boxes, double triangles) {
        return GrowthRow{{around, occluders}, boxes, triangles, 1, boxes / 2, triangles / 2, 1};
    };
    const std::vector<GrowthRow> by_occluders = {row(1024, 64, 100, 20), row(1024, 1024, 800, 200)};
    const auto verdicts = [&](const GrowthRow& many) {
        return check_expectations({row(1024, 64, 100, 20), many}, by_occluders);
    };
    for (const ExpectationResult& e : verdicts(row(1 << 20, 64, 200, 22)))
        EXPECT_EQ(e.verdict, Verdict::holds) << e.text;
    EXPECT_EQ(verdicts(row(1 << 20, 64, 3200, 22))[0].verdict, Verdict::fails);
    EXPECT_EQ(verdicts(row(1 << 20, 64, 200, 40))[1].verdict, Verdict::fails);
}

TEST(LineGrowth, MoreTestsWithMoreOccludersAreNoticed) {
    const auto row = [](int occluders, double boxes, double boxes_together) {
        return GrowthRow{{1024, occluders}, boxes, 20, 1, boxes_together, 10, 1};
    };
    const std::vector<GrowthRow> by_around = {row(64, 100, 50), row(64, 100, 50)};
    const auto verdicts = [&](const GrowthRow& dense) {
        return check_expectations(by_around, {row(64, 100, 50), dense});
    };
    for (const ExpectationResult& e : verdicts(row(1024, 1600, 800)))
        EXPECT_EQ(e.verdict, Verdict::holds) << e.text;
    EXPECT_EQ(verdicts(row(1024, 1700, 800))[2].verdict, Verdict::fails) << "boxes, faster than occluders";
    EXPECT_EQ(verdicts(row(1024, 1600, 1601))[3].verdict, Verdict::fails) << "more boxes together";
    GrowthRow many_triangles = row(1024, 1600, 800);
    many_triangles.triangle_tests = 20 * 16 * 1.3;
    EXPECT_EQ(verdicts(many_triangles)[2].verdict, Verdict::fails) << "triangles, faster than occluders";
}

} // namespace

} // namespace nusselt::lab
