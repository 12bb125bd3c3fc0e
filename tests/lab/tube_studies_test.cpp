// Experiments with tubes that are shaded as lines: each notices what is wrong.

#include "common/source_folder.h"
#include "lab/tubes/light_costs.h"
#include "lab/tubes/light_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace nusselt::lab {

namespace {

void ignore(std::string_view) {}

RunSettings settings() {
    RunSettings result;
    result.scenes = std::filesystem::path(nusselt_test::kSourceFolder) / "scenes";
    return result;
}

int failures(const Report& report) {
    return static_cast<int>(std::count_if(report.expectations.begin(), report.expectations.end(),
                                          [](const auto& e) { return e.verdict == Verdict::fails; }));
}

LightGridResult small_grid(const std::string& name) {
    for (const LightGrid& grid : all_light_grids())
        if (grid.name == name) return run_light_grid(quick(grid), settings(), ignore);
    throw std::logic_error("no grid " + name);
}

TEST(LightGrid, HoldsForCylindersAndNoticesWhatIsWrong) {
    const LightGridResult result = small_grid("tube-approximation");
    ASSERT_EQ(result.cells.size(), 27u);
    const Report report = report_of(result);
    EXPECT_EQ(failures(report), 0) << to_text(report.expectations);
    EXPECT_EQ(report.images.size(), 3 * 4u);
    ASSERT_EQ(report.measured.size(), 1u);
    EXPECT_LE(report.measured[0].value, 1);

    // The widths and the roughnesses in reverse order.
    LightGridResult reversed = result;
    std::reverse(reversed.cells.begin(), reversed.cells.end());
    EXPECT_GE(failures(report_of(reversed)), 4);

    // Analytic shading without its clamp.
    LightGridResult unclamped = result;
    for (GridCell& c : unclamped.cells) c.errors[1] = c.errors[2];
    EXPECT_EQ(failures(report_of(unclamped)), 1);
}

TEST(LightGrid, HoldsForRectangles) {
    const LightGridResult result = small_grid("strip-approximation");
    const Report report = report_of(result);
    EXPECT_EQ(failures(report), 0) << to_text(report.expectations);
    EXPECT_TRUE(report.measured.empty());
    EXPECT_EQ(report.images.size(), 3 * 3u);
}

TEST(LightCosts, HasACostForEachKindAndNoticesDearLines) {
    LightCosts costs = all_light_costs()[0];
    costs.repetitions = 1;
    costs.width = 32;
    costs.lights = 8;
    LightCostsResult result = run_light_costs(costs, settings(), ignore);
    ASSERT_EQ(result.lights.size(), 5u);
    for (const LightCost& cost : result.lights) EXPECT_GT(cost.ns, 0) << cost.light;
    const auto set = [&](const std::string& light, double ratio) {
        for (LightCost& cost : result.lights)
            if (cost.light == light) cost.ratio = ratio;
    };
    set("line", 0.5);
    set("tube without caps", 0.5);
    set("tube with caps", 0.6);
    EXPECT_EQ(failures(report_of(result)), 0);
    set("line", 1.1);
    set("tube with caps", 0.4);
    EXPECT_EQ(failures(report_of(result)), 2);
}

} // namespace

} // namespace nusselt::lab
