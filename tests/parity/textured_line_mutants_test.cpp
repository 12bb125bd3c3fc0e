// The parity tests must reject wrong techniques for lines and tubes whose radiance varies along them.

#include "lab/parity/emission/textured_line_parity.h"
#include "platform_test.h"
#include "shaders/shifted_cells.h"
#include "shaders/stepped_profile.h"

#include <algorithm>

namespace nusselt::parity {

namespace {

class TexturedLineMutants : public PlatformTest {
protected:
    /// No more lights than the quick effort draws.
    auto excesses_of(TexturedLineTechnique technique, const Shader& shader) const {
        const auto wrong = wherever_it_runs(shader);
        return excesses_of_each(wrong, judge_textured_lines(platform(), technique, wrong, 8'000));
    }
};

auto count_of(const std::vector<std::string>& excesses, const std::string& begin) {
    return std::count_if(excesses.begin(), excesses.end(),
                         [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
}

TEST_F(TexturedLineMutants, CellsThatBeginElsewhereAreFound) {
    for (const auto& [variant, excesses] :
         excesses_of(TexturedLineTechnique::line, {"shifted_cells", shaders::kShiftedCells})) {
        SCOPED_TRACE(name_of(variant));
        EXPECT_GT(count_of(excesses, "above the horizon, smooth: density"), 0);
        EXPECT_GT(count_of(excesses, "above the horizon, dotted: first inverse"), 0);
        EXPECT_EQ(count_of(excesses, "close, noisy: density of the sample"), 0) << "samples know their cell";
        EXPECT_EQ(count_of(excesses, "close, noisy: measure"), 0);
    }
}

TEST_F(TexturedLineMutants, ProfilesThatAreNotInterpolatedAreFound) {
    for (const auto& [variant, excesses] :
         excesses_of(TexturedLineTechnique::tube, {"stepped_profile", shaders::kSteppedProfile})) {
        SCOPED_TRACE(name_of(variant));
        EXPECT_GT(count_of(excesses, "above the horizon, smooth: density of the sample"), 0);
        EXPECT_GT(count_of(excesses, "far, noisy: measure"), 0);
        EXPECT_EQ(count_of(excesses, "above the horizon, constant: measure"), 0);
        EXPECT_EQ(count_of(excesses, "black:"), 0);
    }
}

} // namespace

} // namespace nusselt::parity
