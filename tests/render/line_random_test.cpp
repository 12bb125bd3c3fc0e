/// Random numbers of lines: those of one camera ray, or for one purpose, do not come back for another one.

#include "render_cpu/kernel/random.h"
#include "tables/blue_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace nusselt::render_test {
namespace {

using kernel::kLanes;
using render::SampleOrder;

kernel::PixelBlock make_block() {
    kernel::PixelBlock block{};
    for (int i = 0; i < kLanes; ++i) {
        block.x[i] = 17 + static_cast<std::uint32_t>(i);
        block.y[i] = 5;
    }
    return block;
}

class LineRandom : public testing::TestWithParam<SampleOrder> {};

TEST_P(LineRandom, NumbersComeOnce) {
    render_cpu::RenderJob job{};
    job.sample_order = GetParam();
    job.blue_noise = tables::blue_noise().bytes;
    job.lines.count = 16;
    job.camera_rays = 4;
    const kernel::PixelBlock block = make_block();
    std::vector<float> all;
    const auto keep = [&](const kernel::Real& u) {
        float lanes[kLanes];
        u.store(lanes);
        all.insert(all.end(), lanes, lanes + kLanes);
    };
    for (const auto pair : {kernel::kOrientationPair, kernel::kLinePair})
        for (std::uint32_t ray = 0; ray < job.camera_rays; ++ray)
            for (std::uint32_t line = 0; line < 16; line += kLanes) {
                const auto u = random_for_lines(job, block, 1, ray, line, 3, pair);
                keep(u.x);
                keep(u.y);
            }
    ASSERT_EQ(all.size(), 2u * 4 * 16 * 2);
    std::sort(all.begin(), all.end());
    EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
}

INSTANTIATE_TEST_SUITE_P(All, LineRandom, testing::ValuesIn(render::kSampleOrders),
                         [](const auto& test) { return std::string(name_of(test.param)); });

} // namespace
} // namespace nusselt::render_test
