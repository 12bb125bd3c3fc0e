#include "lab/figures/tube_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nusselt::lab {

using proof::tube_lights;
using proof::TubeLight;

namespace {

TEST(TubeNoise, IsBelowThatOfRejectionForEveryLight) {
    for (const TubeLight& light : tube_lights()) {
        const TubeNoise noise = measure_tube_noise(light);
        EXPECT_GT(noise.projected_solid_angle, 0) << light.name;
        EXPECT_LT(noise.projected_solid_angle, noise.rejection) << light.name;
    }
}

// A distant disk straight above: all samples on it weigh the same, and it lies in a square.
TEST(TubeNoise, OfRejectionComesFromMisses) {
    const TubeNoise noise = measure_tube_noise({"distant", {0, 0, 100}, {0, 0, 101}, 0.5});
    EXPECT_NEAR(noise.rejection_hits, std::numbers::pi / 4, 1e-3);
    EXPECT_NEAR(noise.rejection, std::sqrt(4 / std::numbers::pi - 1), 1e-3);
}

TEST(TubeNoise, RatiosOfTimesAreSensible) {
    const double ratio = measure_tube_time_ratio(tube_lights().front(), 3);
    EXPECT_GT(ratio, 0.01);
    EXPECT_LT(ratio, 100);
}

} // namespace

} // namespace nusselt::lab
