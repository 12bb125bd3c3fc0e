// The parity tests must reject wrong techniques for environment maps.

#include "gpu_test.h"
#include "lab/parity/emission/environment_parity.h"
#include "shaders/open_seams.h"
#include "shaders/sharp_horizon.h"

#include <algorithm>

namespace nusselt::parity {

namespace {

class EnvironmentMutants : public GpuTest {
protected:
    /// No more surfaces than the quick effort draws.
    std::vector<std::string> excesses_of(const VariantShader& shader) const {
        return judge_environment(device(), EnvironmentTechnique::cosine, {shader}, 9'000).front().excesses;
    }
};

auto count_of(const std::vector<std::string>& excesses, const std::string& begin) {
    return std::count_if(excesses.begin(), excesses.end(),
                         [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
}

TEST_F(EnvironmentMutants, WeightsThatEndAtTheHorizonAreFound) {
    const auto excesses = excesses_of(shaders::kSharpHorizon);
    for (const char* map : {"sky", "sun", "rough", "spikes", "constant"}) {
        EXPECT_GT(count_of(excesses, std::string(map) + ": measure"), 0) << map;
        EXPECT_GT(count_of(excesses, std::string(map) + ": density of the sample"), 0) << map;
    }
    EXPECT_EQ(count_of(excesses, "black:"), 0);
}

TEST_F(EnvironmentMutants, MapsThatAreNotContinuousAtTheirEdgesAreFound) {
    const auto excesses = excesses_of(shaders::kOpenSeams);
    EXPECT_GT(count_of(excesses, "rough: density of the sample, tail"), 0);
    EXPECT_GT(count_of(excesses, "rough: hit point, tail"), 0);
    EXPECT_EQ(count_of(excesses, "rough: measure"), 0) << "weights come from C++";
    EXPECT_EQ(count_of(excesses, "constant: density of the sample"), 0)
        << "texels across the edge are the same";
}

} // namespace

} // namespace nusselt::parity
