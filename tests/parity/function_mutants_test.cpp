// The parity tests must reject wrong functions.

#include "gpu/fused_fma.h"
#include "lab/parity/groups/estimate_groups.h"
#include "lab/parity/groups/function_groups.h"
#include "lab/parity/groups/ltc_groups.h"
#include "lab/parity/groups/random_numbers.h"
#include "lab/parity/groups/visible_part_group.h"
#include "mutant.h"
#include "platform_test.h"
#include "shaders/capless_part.h"
#include "shaders/plain_lobe.h"
#include "shaders/plain_products.h"
#include "shaders/seamed_table.h"
#include "shaders/swapped_techniques.h"
#include "shaders/unbounded_normals.h"
#include "shaders/unrounded_random.h"

#include <nusselt/random/light_random.h>

namespace nusselt::parity {

namespace {

class FunctionMutant : public PlatformTest {};

TEST_F(FunctionMutant, DifferencesThatCancelAreFound) {
    for (const auto& shader : wherever_it_runs({"plain_products", shaders::kPlainProducts})) {
        SCOPED_TRACE(name_of(shader.variant));
        const auto excesses = judge_group<Arithmetic>(platform(), shader, kMutantCalls).excesses;
        ASSERT_FALSE(excesses.empty());
        for (const std::string& excess : excesses)
            EXPECT_EQ(excess.rfind("difference_of_products, ", 0), 0u) << excess;
    }
}

TEST_F(FunctionMutant, TubesWithoutTheirCapsAreFound) {
    for (const auto& shader : wherever_it_runs({"capless_part", shaders::kCaplessPart})) {
        SCOPED_TRACE(name_of(shader.variant));
        const auto excesses = judge_group<VisibleParts>(platform(), shader, kMutantCalls).excesses;
        ASSERT_FALSE(excesses.empty());
        for (const std::string& excess : excesses)
            EXPECT_NE(excess.find("of a tube"), std::string::npos) << excess;
    }
}

TEST_F(FunctionMutant, TheVariantForAFusedFmaIsRejectedWhereFmaRoundsTwice) {
    if (gpu::has_fused_fma(device())) GTEST_SKIP() << "the device fuses fma";
    EXPECT_FALSE(
        judge_group<Arithmetic>(platform(), VariantShader(Arithmetic::kShader, Variant::fused), kMutantCalls)
            .excesses.empty());
}

class LtcFunctionMutant : public PlatformTest {};

TEST_F(LtcFunctionMutant, ComponentsThatCancelAreFound) {
    for (const auto& shader : wherever_it_runs({"plain_lobe", shaders::kPlainLobe})) {
        SCOPED_TRACE(name_of(shader.variant));
        const auto excesses = judge_group<Lobes>(platform(), shader, kMutantCalls).excesses;
        EXPECT_FALSE(excesses.empty());
        for (const std::string& excess : excesses) EXPECT_EQ(excess.rfind("to_cosine, ", 0), 0u) << excess;
    }
}

TEST_F(LtcFunctionMutant, SeamsAlongTheReflectanceAreFound) {
    for (const auto& shader : wherever_it_runs({"seamed_table", shaders::kSeamedTable})) {
        SCOPED_TRACE(name_of(shader.variant));
        const auto excesses = judge_group<Table>(platform(), shader, kMutantCalls, table_words()).excesses;
        EXPECT_FALSE(excesses.empty());
        for (const std::string& excess : excesses)
            EXPECT_NE(excess.rfind("coloured albedo, ", 0), 0u)
                << "only two samples of f0, so no seam: " << excess;
    }
}

class EstimateMutant : public PlatformTest {};

TEST_F(EstimateMutant, SwappedTechniquesAreFound) {
    for (const auto& shader : wherever_it_runs({"swapped_techniques", shaders::kSwappedTechniques})) {
        SCOPED_TRACE(name_of(shader.variant));
        const auto excesses = judge_group<Heuristics>(platform(), shader, kMutantCalls).excesses;
        EXPECT_FALSE(excesses.empty());
        for (const std::string& excess : excesses)
            EXPECT_TRUE(excess.rfind("shadowed", 0) == 0 || excess.rfind("constant", 0) == 0) << excess;
    }
}

TEST_F(EstimateMutant, UnboundedNormalsAreFound) {
    for (const auto& shader : wherever_it_runs({"unbounded_normals", shaders::kUnboundedNormals})) {
        SCOPED_TRACE(name_of(shader.variant));
        const auto excesses = judge_group<VisibleNormals>(platform(), shader, kMutantCalls).excesses;
        EXPECT_FALSE(excesses.empty());
        for (const std::string& excess : excesses) EXPECT_EQ(excess.rfind("bounded", 0), 0u) << excess;
    }
}

class RandomMutant : public PlatformTest {};

TEST_F(RandomMutant, QuotientsOffByARoundingAreFound) {
    for (const auto& shader : wherever_it_runs({"unrounded_random", shaders::kUnroundedRandom})) {
        SCOPED_TRACE(name_of(shader.variant));
        const auto wrong = different_random_numbers(platform(), shader, kMutantCalls);
        EXPECT_EQ(wrong[static_cast<std::size_t>(Sampler::independent)], 0);
        EXPECT_EQ(wrong[static_cast<std::size_t>(Sampler::sobol)], 0);
        EXPECT_GT(wrong[static_cast<std::size_t>(Sampler::jittered)], 0);
        EXPECT_GT(wrong[static_cast<std::size_t>(Sampler::stratified)], 0);
        EXPECT_EQ(wrong[static_cast<std::size_t>(Sampler::z_sobol)], 0);
        EXPECT_GT(wrong[static_cast<std::size_t>(Sampler::blue_noise)], 0);
        EXPECT_EQ(wrong[kSamplers], 0) << "camera rays need no quotients";
    }
}

} // namespace

} // namespace nusselt::parity
