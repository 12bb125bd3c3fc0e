#include "lab/figures/noise_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace nusselt::lab {

namespace {

/// The noise at the first angle.
double noise_of(const NoiseTableResult& result, const std::string& estimator) {
    return std::find_if(result.rows.begin(), result.rows.end(),
                        [&](const NoiseRow& row) { return row.estimator->label == estimator; })
        ->noise[0]
        .on_plane;
}

TEST(NoiseTable, LimitsHold) {
    for (const NoiseTable& table : all_noise_tables()) {
        NoiseTable limited = table;
        limited.angles = {34, 69};
        const NoiseTableResult result = measure_noise(limited, {8, 256});
        EXPECT_EQ(result.expectations.size(), table.limits.size());
        for (const ExpectationResult& e : result.expectations) EXPECT_TRUE(e.holds) << e.text;
    }
}

// A limit that projected solid angle sampling alone cannot keep is noticed as broken.
TEST(NoiseTable, LimitsFailForAnotherEstimator) {
    NoiseTable mutant = all_noise_tables()[0];
    mutant.angles = {34, 69};
    for (NoiseEstimator& e : mutant.estimators) e.strategies = render::Strategies::diffuse;
    for (const ExpectationResult& e : measure_noise(mutant, {8, 256}).expectations)
        EXPECT_FALSE(e.holds) << e.text;
}

// A rough surface without reflectance at normal incidence is almost Lambertian seen from above.
TEST(NoiseTable, IsLowWhereTheTechniqueIsAlmostExact) {
    NoiseTable diffuse = all_noise_tables()[0];
    diffuse.surfaces = {{"rough", 0.5, 0}};
    diffuse.roughnesses = {1};
    diffuse.angles = {0};
    diffuse.limits = {};
    const NoiseTableResult result = measure_noise(diffuse, {4, 256});
    EXPECT_LT(noise_of(result, "projected_solid_angle"), 0.05);
    EXPECT_GT(noise_of(result, "projected_solid_angle"), 0);
}

TEST(NoiseTable, IsDeterministicAndRejectsLimitsOfNothing) {
    NoiseTable table = all_noise_tables()[0];
    table.angles = {34};
    table.limits = {};
    EXPECT_EQ(noise_of(measure_noise(table, {4, 16}), "balance"),
              noise_of(measure_noise(table, {4, 16}), "balance"));
    table.limits = {{&Noise::on_plane, "balance", table.surfaces[0].name, 35, 1}};
    EXPECT_THROW(measure_noise(table, {4, 16}), std::logic_error);
}

} // namespace

} // namespace nusselt::lab
