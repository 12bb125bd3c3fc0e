// The experiments that render no comparison: each holds with little effort, and notices what is wrong.

#include "common/source_folder.h"
#include "lab/accuracy/accuracy_experiment.h"
#include "lab/figures/error_images.h"
#include "lab/figures/map_experiment.h"
#include "lab/fuzzing/worst_case_experiment.h"
#include "lab/report/published_values.h"
#include "lab/statements/sector_iterations.h"
#include "lab/statements/statement_set.h"
#include "lab/timing/cost_experiments.h"
#include "published_names.h"

#include <nusselt/related/polygon_projected_solid_angle_peters.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

namespace nusselt::lab {

namespace {

void ignore(std::string_view) {}

RunSettings settings() {
    RunSettings result;
    result.scenes = std::filesystem::path(nusselt_test::kSourceFolder) / "scenes";
    return result;
}

void expect_all_hold(const Report& report) {
    EXPECT_FALSE(report.expectations.empty());
    expect_names_of_published_numbers(report);
    for (const ExpectationResult& e : report.expectations) EXPECT_EQ(e.verdict, Verdict::holds) << e.text;
}

int failures(const Report& report) {
    return static_cast<int>(std::count_if(report.expectations.begin(), report.expectations.end(),
                                          [](const auto& e) { return e.verdict == Verdict::fails; }));
}

TEST(WorstCaseStudy, FindsThePublishedWorstCasesAndNoticesDivergence) {
    WorstCaseStudy study = quick(all_worst_case_studies()[0]);
    study.cases = 2000;
    WorstCaseStudyResult result = run_worst_case_study(study, settings(), ignore);
    expect_all_hold(report_of(result));
    result.divergent_ours = 1e-3L;
    EXPECT_EQ(failures(report_of(result)), 1);
}

TEST(ErrorImages, ShowErrorsOfPublishedMethodsOnly) {
    for (ErrorImages experiment : all_error_images()) {
        experiment.width = 96;
        const ErrorImagesResult result = run_error_images(experiment, settings(), ignore);
        const Report report = report_of(result);
        expect_all_hold(report);
        EXPECT_EQ(report.images.size(), 1 + 2 * experiment.techniques.size());
        EXPECT_GT(report.inputs.size(), 1u) << "the scene and what it includes";
    }
}

// A published method that poses as ours.
TEST(ErrorImages, FailForAnImpostor) {
    ErrorImages mutant = all_error_images()[0];
    mutant.width = 96;
    std::reverse(mutant.techniques.begin(), mutant.techniques.end());
    EXPECT_EQ(failures(report_of(run_error_images(mutant, settings(), ignore))), 2);
    mutant.techniques = {"LineArea"};
    EXPECT_THROW(run_error_images(mutant, settings(), ignore), std::invalid_argument);
}

TEST(AccuracyStudy, HoldsAndNoticesAnInvalidResult) {
    AccuracyStudy study = all_accuracy_studies()[0];
    study.count = 300;
    AccuracyStudyResult result = run_accuracy_study(study, settings(), ignore);
    expect_all_hold(report_of(result));
    for (auto& row : result.table.rows)
        if (row.method == "ours") row.nan = 1;
    EXPECT_EQ(failures(report_of(result)), 1);
}

std::set<std::string> items_shown_by(const std::string& experiment) {
    std::ifstream file(std::filesystem::path(nusselt_test::kSourceFolder) / "lab/report/published.json");
    const auto published = nlohmann::json::parse(file);
    std::set<std::string> items;
    for (const auto& paper : published.at("papers"))
        for (const auto& item : paper.at("items"))
            for (const auto& name : item.at("by"))
                if (name == experiment) items.insert(item.at("id"));
    return items;
}

TEST(StatementSets, HoldAndMeasureTheItemsThatNameThem) {
    for (const StatementSet& set : all_statement_sets()) {
        const StatementSetResult result = run_statement_set(quick(set), settings(), ignore);
        expect_all_hold(report_of(result));
        std::set<std::string> measured;
        for (const Finding& f : result.findings.all) measured.insert(f.item);
        EXPECT_EQ(measured, items_shown_by(set.name)) << set.name;
    }
}

TEST(StatementSets, FailOutsideOfTheRangeAndForNaN) {
    EXPECT_TRUE(holds(at_most("", "", 1, 1)));
    EXPECT_TRUE(holds(at_least("", "", 1, 1)));
    EXPECT_FALSE(holds(at_most("", "", 1.01, 1)));
    EXPECT_FALSE(holds(at_least("", "", 0.99, 1)));
    EXPECT_FALSE(holds(between("", "", 3.2, 2.9, 3.1)));
    EXPECT_FALSE(holds(at_most("", "", std::nan(""), 1)));
    const Findings findings = {{at_most("", "", 2, 1), at_most("", "", 1, 1)}};
    EXPECT_EQ(failures(report_of(StatementSetResult{{}, findings})), 1);
}

/// The simple form of the iteration beside that of the technique. Two steps leave differences at rounding, one does not.
TEST(SectorIterations, TangentsAreThoseOfThePublishedIteration) {
    using Real = long double;
    for (const Real sweep : {0.3L, 1.5L, 2.9L}) {
        const Vec2<Real> inner{1.5L, 2}, outer{0.4L, 0.7L};
        const auto sector = TwoEllipses<Real>::between(sweep, inner, outer);
        const Real x = std::cos(sweep), y = std::sin(sweep);
        const Vec3<Real> corners[] = {{1, 0, outer.x}, {x, y, outer.y}, {x, y, inner.y}, {1, 0, inner.x}};
        const PolygonProjectedSolidAnglePeters<Real, 4> published(make_polygon<4>(corners, 4));
        EXPECT_NEAR(static_cast<double>(sector.area() / published.measure()), 1, 1e-14);
        for (const Real share : {0.1L, 0.45L, 0.8L}) {
            const Vec3<Real> wi = published.direction({share, 0.5L});
            const Real one_step = sector.tangent_step(sector.start_with_quads(2, share), share);
            const Real two_steps = sector.tangent_step(one_step, share);
            const auto expected = static_cast<double>(std::atan2(wi.y, wi.x));
            EXPECT_NEAR(static_cast<double>(two_steps), expected, 1e-13);
            if (sweep > 2) {
                EXPECT_GT(std::fabs(static_cast<double>(one_step) - expected), 1e-8);
            }
            EXPECT_NEAR(static_cast<double>(sector.share_to(sector.exact_azimuth(share))),
                        static_cast<double>(share), 1e-15);
        }
    }
}

/// Costs that the code does not decide: those of the published methods, and 10 for ours.
CostTableResult with_costs(const CostTable& table, double published) {
    CostTableResult result = {table, {{name_of_code(1), "avx2"}, {name_of_code(8), "avx2"}}, {}};
    for (const CostRow& row : table.rows)
        for (const int n : table.vertices)
            for (const int lanes : {1, 8}) {
                const auto has = [&](const char* text) { return row.label.find(text) != std::string::npos; };
                const bool is_costly = has("Arvo") || has("Li et al.") || has("biquadratic") ||
                                       has("quadratic") || has("clipped solid angle, crossing") ||
                                       has("rectangle, ") || has("quad, ");
                SamplerTiming timing;
                timing.technique = row.technique;
                timing.configuration = row.lights + (n == 0 ? "" : ", " + std::to_string(n) + " vertices");
                timing.code = name_of_code(lanes);
                timing.isa = "avx2";
                timing.prepare_ns = 0;
                timing.once_ns = timing.sample_ns = is_costly ? published : 10;
                // What one technique costs more than another one with a row for the same lights.
                if (has("decentral, ours") && !has("biased")) timing.sample_ns = published;
                if (has("decentral, Arvo")) timing.sample_ns = published * published / 10;
                timing.prepare_spread_ns = timing.sample_spread_ns = timing.once_spread_ns = 1;
                result.rows.push_back(timing);
            }
    return result;
}

TEST(CostTable, ChecksThatPublishedMethodsCostMore) {
    for (const CostTable& table : all_cost_tables()) {
        expect_all_hold(report_of(with_costs(table, 25)));
        EXPECT_GT(failures(report_of(with_costs(table, 5))), 3) << table.name;
    }
}

TEST(CostTable, ScalesPublishedTimesSoThatRatiosCanBeReadOff) {
    const CostTable table = all_cost_tables()[0];
    CostTableResult result = {table, {{name_of_code(1), "avx2"}, {name_of_code(8), "avx2"}}, {}};
    // As in the paper, in units of 7 ns.
    for (const CostRow& row : table.rows)
        for (const int n : table.vertices)
            for (const int lanes : {1, 8}) {
                const auto published = [&](const char* column) {
                    return published_value(table.item, row.label + column + std::to_string(n) + " vertices");
                };
                SamplerTiming timing;
                timing.technique = row.technique;
                timing.configuration = row.lights + ", " + std::to_string(n) + " vertices";
                timing.code = name_of_code(lanes);
                timing.isa = "avx2";
                timing.prepare_ns = 0;
                timing.once_ns = 7 * published(", 128 lights, ").value_or(1);
                timing.sample_ns = 7 * published(", 128 samples, ").value_or(1);
                timing.prepare_spread_ns = timing.sample_spread_ns = timing.once_spread_ns = 0;
                result.rows.push_back(timing);
            }
    int compared = 0;
    for (const Measured& m : report_of(result).measured) {
        if (m.item != table.item) continue;
        ++compared;
        EXPECT_NEAR(m.value, published_value(m.item, m.quantity).value(), 1e-9) << m.quantity;
    }
    EXPECT_GT(compared, 60) << "cells of the table";
}

TEST(CostTable, HasACostForEachTechniqueAndClassOfLights) {
    for (CostTable table : all_cost_tables()) {
        table.repetitions = 1;
        const CostTableResult result = run_cost_table(table, settings(), ignore);
        const Report report = report_of(result);
        ASSERT_EQ(report.tables.size(), 2 + 2 * result.codes.size());
        // AVX2 has all numbers of vertices.
        if (result.codes[1].isa != "avx2") continue;
        for (std::size_t i = 2; i < 6; ++i) {
            ASSERT_EQ(report.tables[i].size(), 1 + table.rows.size());
            for (std::size_t row = 1; row < report.tables[i].size(); ++row)
                for (std::size_t column = 1; column < report.tables[i][row].size(); ++column)
                    // There are no rectangles but those with four vertices.
                    EXPECT_TRUE(!report.tables[i][row][column].empty() ||
                                table.rows[row - 1].technique == "RectangleSolidAngle")
                        << table.rows[row - 1].label << ", column " << column;
        }
    }
}

TEST(MapSet, DrawsEachTechnique) {
    MapSet set = all_map_sets()[0];
    const Report report = report_of(run_map_set(set, settings(), ignore));
    ASSERT_EQ(report.drawings.size(), set.techniques.size());
    for (const Drawing& drawing : report.drawings)
        EXPECT_NE(drawing.svg.find("</svg>"), std::string::npos) << drawing.title;
    set.techniques = {"NoSuchTechnique"};
    EXPECT_THROW(run_map_set(set, settings(), ignore), std::runtime_error);
}

} // namespace

} // namespace nusselt::lab
