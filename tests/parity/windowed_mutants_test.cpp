// The parity tests must reject wrong techniques for polygons whose radiance depends on the direction.

#include "lab/parity/emission/windowed_parity.h"
#include "platform_test.h"
#include "shaders/flat_texels.h"
#include "shaders/lost_borrow.h"

#include <algorithm>

namespace nusselt::parity {

namespace {

class WindowedMutants : public PlatformTest {
protected:
    /// No more surfaces than the quick effort draws.
    std::vector<std::string> excesses_of(const Shader& shader) const {
        return judge_windowed(platform(), WindowedTechnique::diffuse, {where_it_compiles_fast(shader)}, 2'800)
            .front()
            .excesses;
    }
};

auto count_of(const std::vector<std::string>& excesses, const std::string& begin) {
    return std::count_if(excesses.begin(), excesses.end(),
                         [&](const std::string& excess) { return excess.rfind(begin, 0) == 0; });
}

TEST_F(WindowedMutants, DifferencesThatForgetTheBorrowAreFound) {
    const auto excesses = excesses_of({"lost_borrow", shaders::kLostBorrow});
    for (const char* surfaces : {"above the horizon, sun", "close, rough", "close, sky"}) {
        EXPECT_GT(count_of(excesses, std::string(surfaces) + ": measure"), 0) << surfaces;
        EXPECT_GT(count_of(excesses, std::string(surfaces) + ": density of the sample"), 0) << surfaces;
    }
    EXPECT_EQ(count_of(excesses, "behind the light:"), 0);
}

TEST_F(WindowedMutants, TexelsOfTheSameSolidAngleAreFound) {
    const auto excesses = excesses_of({"flat_texels", shaders::kFlatTexels});
    EXPECT_GT(count_of(excesses, "close, rough: density of the sample"), 0);
    EXPECT_EQ(count_of(excesses, "close, rough: measure"), 0) << "the weights of cells are correct";
    EXPECT_EQ(count_of(excesses, "close, sky: density of the sample, median"), 0)
        << "smooth cells have no texels";
}

} // namespace

} // namespace nusselt::parity
