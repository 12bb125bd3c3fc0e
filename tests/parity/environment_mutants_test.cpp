// The parity tests must reject wrong techniques for environment maps.

#include "lab/parity/emission/environment_parity.h"
#include "platform_test.h"
#include "shaders/open_seams.h"
#include "shaders/sharp_horizon.h"

#include <algorithm>

namespace nusselt::parity {

namespace {

class EnvironmentMutants : public PlatformTest {
protected:
    /// No more surfaces than the quick effort draws.
    auto excesses_of(const Shader& shader) const {
        const auto wrong = wherever_it_runs(shader);
        return excesses_of_each(wrong,
                                judge_environment(platform(), EnvironmentTechnique::cosine, wrong, 9'000));
    }
};

auto count_of(const std::vector<std::string>& excesses, const std::string& begin) {
    return std::count_if(excesses.begin(), excesses.end(),
                         [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
}

TEST_F(EnvironmentMutants, WeightsThatEndAtTheHorizonAreFound) {
    for (const auto& [variant, excesses] : excesses_of({"sharp_horizon", shaders::kSharpHorizon})) {
        SCOPED_TRACE(name_of(variant));
        for (const char* map : {"sky", "sun", "rough", "spikes", "constant"}) {
            EXPECT_GT(count_of(excesses, std::string(map) + ": measure"), 0) << map;
            EXPECT_GT(count_of(excesses, std::string(map) + ": density of the sample"), 0) << map;
        }
        EXPECT_EQ(count_of(excesses, "black:"), 0);
    }
}

TEST_F(EnvironmentMutants, MapsThatAreNotContinuousAtTheirEdgesAreFound) {
    for (const auto& [variant, excesses] : excesses_of({"open_seams", shaders::kOpenSeams})) {
        SCOPED_TRACE(name_of(variant));
        EXPECT_GT(count_of(excesses, "rough: density of the sample, tail"), 0);
        EXPECT_GT(count_of(excesses, "rough: hit point, tail"), 0);
        EXPECT_EQ(count_of(excesses, "rough: measure"), 0) << "weights come from C++";
        EXPECT_EQ(count_of(excesses, "constant: density of the sample"), 0)
            << "texels across the edge are the same";
    }
}

} // namespace

} // namespace nusselt::parity
