// The parity tests must reject wrong functions.

#include "gpu/fused_fma.h"
#include "gpu_test.h"
#include "lab/parity/groups/estimate_groups.h"
#include "lab/parity/groups/function_groups.h"
#include "lab/parity/groups/ltc_groups.h"
#include "lab/parity/groups/random_numbers.h"
#include "mutant.h"
#include "shaders/plain_lobe.h"
#include "shaders/plain_products.h"
#include "shaders/seamed_table.h"
#include "shaders/swapped_techniques.h"
#include "shaders/unbounded_normals.h"
#include "shaders/unrounded_random.h"

#include <nusselt/random/light_random.h>

namespace nusselt::parity {

namespace {

class FunctionMutant : public GpuTest {};

TEST_F(FunctionMutant, DifferencesThatCancelAreFound) {
    const auto excesses = judge_group<Arithmetic>(device(), shaders::kPlainProducts, kMutantCalls).excesses;
    ASSERT_FALSE(excesses.empty());
    for (const std::string& excess : excesses)
        EXPECT_EQ(excess.rfind("difference_of_products, ", 0), 0u) << excess;
}

TEST_F(FunctionMutant, TheVariantForAFusedFmaIsRejectedWhereFmaRoundsTwice) {
    if (gpu::has_fused_fma(device())) GTEST_SKIP() << "the device fuses fma";
    EXPECT_FALSE(judge_group<Arithmetic>(device(), {Arithmetic::kShader, Variant::fused}, kMutantCalls)
                     .excesses.empty());
}

class LtcFunctionMutant : public GpuTest {};

TEST_F(LtcFunctionMutant, ComponentsThatCancelAreFound) {
    const auto excesses = judge_group<Lobes>(device(), shaders::kPlainLobe, kMutantCalls).excesses;
    EXPECT_FALSE(excesses.empty());
    for (const std::string& excess : excesses) EXPECT_EQ(excess.rfind("to_cosine, ", 0), 0u) << excess;
}

TEST_F(LtcFunctionMutant, SeamsAlongTheReflectanceAreFound) {
    const auto excesses =
        judge_group<Table>(device(), shaders::kSeamedTable, kMutantCalls, table_words()).excesses;
    EXPECT_FALSE(excesses.empty());
    for (const std::string& excess : excesses)
        EXPECT_NE(excess.rfind("coloured albedo, ", 0), 0u)
            << "only two samples of f0, so no seam: " << excess;
}

class EstimateMutant : public GpuTest {};

TEST_F(EstimateMutant, SwappedTechniquesAreFound) {
    const auto excesses =
        judge_group<Heuristics>(device(), shaders::kSwappedTechniques, kMutantCalls).excesses;
    EXPECT_FALSE(excesses.empty());
    for (const std::string& excess : excesses)
        EXPECT_TRUE(excess.rfind("shadowed", 0) == 0 || excess.rfind("constant", 0) == 0) << excess;
}

TEST_F(EstimateMutant, UnboundedNormalsAreFound) {
    const auto excesses =
        judge_group<VisibleNormals>(device(), shaders::kUnboundedNormals, kMutantCalls).excesses;
    EXPECT_FALSE(excesses.empty());
    for (const std::string& excess : excesses) EXPECT_EQ(excess.rfind("bounded", 0), 0u) << excess;
}

class RandomMutant : public GpuTest {};

TEST_F(RandomMutant, QuotientsOffByARoundingAreFound) {
    const auto wrong = different_random_numbers(device(), shaders::kUnroundedRandom, kMutantCalls);
    EXPECT_EQ(wrong[static_cast<std::size_t>(Sampler::independent)], 0);
    EXPECT_EQ(wrong[static_cast<std::size_t>(Sampler::sobol)], 0);
    EXPECT_GT(wrong[static_cast<std::size_t>(Sampler::jittered)], 0);
    EXPECT_GT(wrong[static_cast<std::size_t>(Sampler::stratified)], 0);
    EXPECT_EQ(wrong[static_cast<std::size_t>(Sampler::z_sobol)], 0);
    EXPECT_GT(wrong[static_cast<std::size_t>(Sampler::blue_noise)], 0);
    EXPECT_EQ(wrong[kSamplers], 0) << "camera rays need no quotients";
}

} // namespace

} // namespace nusselt::parity
