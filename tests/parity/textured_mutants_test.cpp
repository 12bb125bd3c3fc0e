// The parity tests must reject wrong techniques for polygons with textures.

#include "lab/parity/emission/textured_parity.h"
#include "platform_test.h"
#include "shaders/flat_descent.h"
#include "shaders/open_cells.h"

#include <algorithm>

namespace nusselt::parity {

namespace {

class TexturedMutants : public PlatformTest {
protected:
    /// No more lights than the quick effort draws.
    std::vector<std::string> excesses_of(const Shader& shader) const {
        return judge_textured(platform(), TexturedTechnique::diffuse, {where_it_compiles_fast(shader)},
                              12'000)
            .front()
            .excesses;
    }
};

auto count_of(const std::vector<std::string>& excesses, const std::string& begin) {
    return std::count_if(excesses.begin(), excesses.end(),
                         [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
}

TEST_F(TexturedMutants, CellsThatTheOutlineDoesNotCloseAreFound) {
    const auto excesses = excesses_of({"open_cells", shaders::kOpenCells});
    EXPECT_GT(count_of(excesses, "above the horizon, smooth: measure"), 0);
    EXPECT_GT(count_of(excesses, "close, busy: density of the sample"), 0);
    EXPECT_EQ(count_of(excesses, "black:"), 0);
}

TEST_F(TexturedMutants, DescentWithoutTheCosineIsFound) {
    const auto excesses = excesses_of({"flat_descent", shaders::kFlatDescent});
    EXPECT_GT(count_of(excesses, "above the horizon, busy: density of the sample"), 0);
    EXPECT_EQ(count_of(excesses, "close, busy: measure"), 0) << "the lattice is correct";
    EXPECT_EQ(count_of(excesses, "close, smooth: density of the sample"), 0)
        << "smooth cells have no descent";
}

} // namespace

} // namespace nusselt::parity
