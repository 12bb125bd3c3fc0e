#include "lab/timing/sampler_timing.h"
#include "lab/timing/sampler_timing_lights.h"
#include "proof/techniques/registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nusselt::lab {

namespace {

TEST(SamplerTiming, HasARowForEachTechniqueInScalarAndPackCode) {
    const auto rows = time_samplers({3, "sse42"});
    using namespace hostile;
    KindsWithBounds<4>::for_each([&]<class Kind> {
        for (const int lanes : {1, 4})
            EXPECT_TRUE(std::any_of(
                rows.begin(), rows.end(),
                [&](const SamplerTiming& r) { return r.technique == Kind::kName && r.lanes == lanes; }))
                << Kind::kName << " with " << lanes << " lanes";
    });
    for (const SamplerTiming& r : rows) {
        EXPECT_TRUE(std::isfinite(r.prepare_ns) && std::isfinite(r.sample_ns)) << r.technique;
        EXPECT_EQ(r.isa, "sse42");
    }
}

// The iteration of the decentral case cannot be cheaper than a few multiplications.
TEST(SamplerTiming, TellsAnExpensiveTechniqueFromACheapOne) {
    const auto rows = time_samplers({15, "sse42"});
    const auto cost = [&](const char* technique) {
        return std::find_if(rows.begin(), rows.end(),
                            [&](const SamplerTiming& r) {
                                return r.technique == technique && r.lanes == 1 &&
                                       r.configuration == "decentral, 4 vertices";
                            })
            ->prepare_ns;
    };
    EXPECT_GT(cost("PolygonProjectedSolidAngle"), 2 * cost("PolygonArea"));
}

TEST(SamplerTiming, ComparesWithPublishedFormulas) {
    EXPECT_EQ(competitor_of("PolygonSolidAngle"), "PolygonSolidAnglePeters");
    EXPECT_EQ(competitor_of("LineProjectedSolidAngle"), "LineProjectedSolidAnglePeters");
    EXPECT_EQ(competitor_of("PolygonProjectedSolidAngleBiased"), "PolygonProjectedSolidAnglePeters")
        << "those of the technique that it approximates";
    EXPECT_EQ(competitor_of("PolygonLtcBiased"), "") << "the technique that it approximates has none";
    EXPECT_EQ(competitor_of("PolygonSolidAnglePeters"), "") << "it has the published formulas itself";
}

TEST(SamplerTiming, NamesAnUnknownInstructionSet) {
    try {
        time_samplers({1, "mmx"});
        FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "unknown instruction set 'mmx'; use sse42, avx2 or avx512");
    }
}

} // namespace

} // namespace nusselt::lab
