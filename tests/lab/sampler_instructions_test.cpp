#include "common/source_folder.h"
#include "lab/timing/sampler_instructions.h"
#include "lab/timing/sampler_timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/isa.h"

namespace nusselt::lab {

namespace {

const char* const kUpdate = "\nIf this is intended, run\n"
                            "  nusselt-lab bench instructions --isa avx2 --json docs/data/instructions.json\n"
                            "  scripts/update-docs.sh tables\n";

// The same compiler makes the same instructions from the same source, apart from what it inlines elsewhere in a unit. A step
// more of an iteration, a lost early exit or a square root instead of a product change more than this.
constexpr double kTolerance = 0.1;

const SamplerInstructionTable& committed() {
    static const SamplerInstructionTable table = read_sampler_instructions(
        std::filesystem::path(nusselt_test::kSourceFolder) / "docs" / "data" / "instructions.json");
    return table;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

/// The technique whose samples the mutant takes.
constexpr const char* kSlowed = "PolygonProjectedSolidAngle";
TimedTechnique original;

/// Takes every fourth sample twice.
void take_more_samples(const void* technique, const void* random, int count) {
    original.sample(technique, random, count);
    static int taken = 0;
    for (int i = 0; i < count; ++i)
        if (++taken % 4 == 0) original.sample(technique, random, 1);
}

/// The rows of one technique.
SamplerInstructionTable only(const char* technique, SamplerInstructionTable table) {
    const auto differs = [&](const SamplerInstructions& row) { return row.technique != technique; };
    table.rows.erase(std::remove_if(table.rows.begin(), table.rows.end(), differs), table.rows.end());
    return table;
}

/// Whether numbers of this program and machine compare with the committed ones; a reason if not.
std::string obstacle() {
    if (!base::is_supported(base::Isa::avx2)) return "this processor lacks AVX2";
    const auto one = count_sampler_instructions(base::Isa::avx2, {});
    if (one.compiler != committed().compiler)
        return "docs/data/instructions.json is for " + committed().compiler + ", this is " + one.compiler;
    return "";
}

TEST(SamplerInstructions, AreThoseOfTheCommittedTable) {
    if (!obstacle().empty()) GTEST_SKIP() << obstacle();
    const auto now = count_sampler_instructions(base::Isa::avx2, timed_techniques_for(base::Isa::avx2));
    if (now.rows.empty()) GTEST_SKIP() << "this machine cannot count instructions";
    const auto moved = moved_costs(committed(), now, kTolerance);
    EXPECT_TRUE(moved.empty()) << joined(moved) << kUpdate;
}

TEST(SamplerInstructions, ShowASamplerThatIsSlowerByAQuarter) {
    if (!obstacle().empty()) GTEST_SKIP() << obstacle();
    std::vector<TimedTechnique> techniques = timed_techniques_for(base::Isa::avx2);
    const auto is_left_out = [](const TimedTechnique& t) {
        return t.name != std::string(kSlowed) && t.name != std::string("Baseline");
    };
    techniques.erase(std::remove_if(techniques.begin(), techniques.end(), is_left_out), techniques.end());
    const auto now = count_sampler_instructions(base::Isa::avx2, techniques);
    if (now.rows.empty()) GTEST_SKIP() << "this machine cannot count instructions";
    EXPECT_EQ(joined(moved_costs(only(kSlowed, committed()), now, kTolerance)), "");
    EXPECT_EQ(joined(moved_costs(now, count_sampler_instructions(base::Isa::avx2, techniques), 0)), "")
        << "each run has the same numbers";

    for (TimedTechnique& t : techniques)
        if (t.name == std::string(kSlowed) && t.lanes == 1 && t.vertex_count == 4) {
            original = t;
            t.sample = take_more_samples;
        }
    const auto slower = moved_costs(only(kSlowed, committed()),
                                    count_sampler_instructions(base::Isa::avx2, techniques), kTolerance);
    ASSERT_EQ(slower.size(), 2u) << joined(slower) << "decentral lights and those that cross the horizon";
    for (const std::string& line : slower)
        EXPECT_NE(line.find("scalar: a sample takes"), std::string::npos) << line;
}

TEST(SamplerInstructions, OfOtherTablesAreMissedInBothDirections) {
    const SamplerInstructions row = {"PolygonArea", "decentral, 4 vertices", "scalar", 100, 50};
    const SamplerInstructionTable before = {"avx2", "g++ 12", {row}};
    SamplerInstructionTable now = before;
    EXPECT_TRUE(moved_costs(before, now, 0.1).empty());
    now.rows[0].prepare = 115;
    EXPECT_EQ(joined(moved_costs(before, now, 0.1)),
              "PolygonArea, decentral, 4 vertices, scalar: preparing takes 115 instructions, not 100\n");
    now.rows[0].prepare = 113; // a tenth and a few
    EXPECT_TRUE(moved_costs(before, now, 0.1).empty());
    now.rows[0].sample = 40;
    EXPECT_EQ(moved_costs(before, now, 0.1).size(), 1u) << "improvements are to be committed, too";
    now.rows[0].technique = "LineArea";
    EXPECT_EQ(moved_costs(before, now, 0.1).size(), 2u) << "one is new and one is gone";
    EXPECT_THROW(read_sampler_instructions("no/such/file.json"), std::runtime_error);
}

} // namespace

} // namespace nusselt::lab
