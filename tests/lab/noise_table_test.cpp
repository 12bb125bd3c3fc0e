#include "lab/figures/noise_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace nusselt::lab {

namespace {

NoiseTableResult measure_noise(const NoiseTable& table) {
    return run_noise_table(table, RunSettings(), [](std::string_view) {});
}

/// With few points and estimates.
NoiseTable reduced(NoiseTable table, int points, int samples) {
    table.points = points;
    table.samples = samples;
    return table;
}

/// The noise at the first angle.
double noise_of(const NoiseTableResult& result, const std::string& estimator) {
    return std::find_if(result.rows.begin(), result.rows.end(),
                        [&](const NoiseRow& row) { return row.estimator->label == estimator; })
        ->noise[0]
        .on_plane;
}

TEST(NoiseTable, LimitsHold) {
    for (const NoiseTable& table : all_noise_tables()) {
        NoiseTable limited = quick(table);
        limited.angles = {34, 69};
        const NoiseTableResult result = measure_noise(limited);
        EXPECT_EQ(result.expectations.size(), table.limits.size());
        for (const ExpectationResult& e : result.expectations) EXPECT_EQ(e.verdict, Verdict::holds) << e.text;
    }
}

// A limit that projected solid angle sampling alone cannot keep is noticed as broken.
TEST(NoiseTable, LimitsFailForAnotherEstimator) {
    NoiseTable mutant = quick(all_noise_tables()[0]);
    mutant.angles = {34, 69};
    for (NoiseEstimator& e : mutant.estimators) e.strategies = render::Strategies::diffuse;
    for (const ExpectationResult& e : measure_noise(mutant).expectations)
        EXPECT_EQ(e.verdict, Verdict::fails) << e.text;
}

// A rough surface without reflectance at normal incidence is almost Lambertian seen from above.
TEST(NoiseTable, IsLowWhereTheTechniqueIsAlmostExact) {
    NoiseTable diffuse = reduced(all_noise_tables()[0], 4, 256);
    diffuse.surfaces = {{"rough", 0.5, 0}};
    diffuse.roughnesses = {1};
    diffuse.angles = {0};
    diffuse.limits = {};
    const NoiseTableResult result = measure_noise(diffuse);
    EXPECT_LT(noise_of(result, "projected_solid_angle"), 0.05);
    EXPECT_GT(noise_of(result, "projected_solid_angle"), 0);
}

TEST(NoiseTable, IsDeterministicAndRejectsLimitsOfNothing) {
    NoiseTable table = reduced(all_noise_tables()[0], 4, 16);
    table.angles = {34};
    table.limits = {};
    EXPECT_EQ(noise_of(measure_noise(table), "balance"), noise_of(measure_noise(table), "balance"));
    table.limits = {{&Noise::on_plane, "balance", table.surfaces[0].name, 35, 1}};
    EXPECT_THROW(measure_noise(table), std::logic_error);
}

} // namespace

} // namespace nusselt::lab
