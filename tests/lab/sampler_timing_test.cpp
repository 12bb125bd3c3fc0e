#include "base/isa.h"
#include "lab/timing/child_process.h"
#include "lab/timing/sampler_timing.h"
#include "lab/timing/sampler_timing_lights.h"
#include "lab/timing/scalar_programs.h"
#include "proof/techniques/registry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace nusselt::lab {

namespace {

const SamplerTiming* find(const std::vector<SamplerTiming>& rows, const std::string& technique,
                          const std::string& code, const std::string& lights = "") {
    for (const SamplerTiming& r : rows)
        if (r.technique == technique && r.code == code && (lights.empty() || r.configuration == lights))
            return &r;
    return nullptr;
}

/// The name of the suite in techniques.json.
struct TimingSuite {
    static constexpr std::string_view kName = "timing";
};

TEST(SamplerTiming, HasARowForEachTechniqueInScalarAndPackCode) {
    SamplerTimingSettings settings;
    settings.repetitions = 3;
    settings.isa = "sse42";
    const auto rows = time_samplers(settings);
    using namespace hostile;
    TestedBy<TimingSuite, KindsWithBounds<4>>::for_each([&]<class Kind> {
        for (const char* code : {"scalar", "packs of 4, per lane"}) {
            EXPECT_NE(find(rows, Kind::kName, code), nullptr) << Kind::kName << ", " << code;
            if (std::is_same_v<typename Kind::template Published<float>, Absent>) continue;
            for (const char* technique : {Kind::kName, Kind::kPublishedName}) {
                const SamplerTiming* const row = find(rows, technique, code);
                ASSERT_NE(row, nullptr) << technique << ", " << code;
                EXPECT_TRUE(row->world_ns) << technique << ", " << code;
                EXPECT_EQ(row->direction_ns.has_value(), technique == Kind::kPublishedName) << technique;
            }
        }
    });
    for (const SamplerTiming& r : rows) {
        ASSERT_TRUE(r.prepare_ns && r.once_ns && r.sample_ns) << r.technique;
        EXPECT_TRUE(std::isfinite(*r.prepare_ns) && std::isfinite(*r.once_ns) && std::isfinite(*r.sample_ns))
            << r.technique;
        EXPECT_EQ(r.isa, "sse42");
    }
}

TEST(SamplerTiming, HasEachNumberOfVerticesAndTwoRegistersInFlight) {
    if (!base::is_supported(base::Isa::avx2)) GTEST_SKIP() << "this processor lacks AVX2";
    SamplerTimingSettings settings;
    settings.repetitions = 1;
    settings.isa = "avx2";
    settings.configurations = {"above the horizon"};
    for (const int n : {3, 4, 5, 6, 7})
        settings.configurations.push_back("decentral, " + std::to_string(n) + " vertices");
    const auto rows = time_samplers(settings);
    using namespace hostile;
    PolygonKinds<4>::for_each([&]<class Kind> {
        for (const int n : {3, 4, 5, 6, 7})
            for (const char* code : {"scalar", "packs of 8, per lane"})
                EXPECT_NE(find(rows, Kind::kName, code, "decentral, " + std::to_string(n) + " vertices"),
                          nullptr)
                    << Kind::kName << ", " << n << ", " << code;
    });
    for (const char* technique : {"PolygonSolidAngle", "PolygonSolidAnglePeters", "LineProjectedSolidAngle"})
        EXPECT_NE(find(rows, technique, "packs of 16, per lane"), nullptr) << technique;
    EXPECT_EQ(find(rows, "PolygonSolidAngle", "scalar", "central, 4 vertices"), nullptr) << "nobody asked";
}

// The iteration of the decentral case cannot be cheaper than a few multiplications.
TEST(SamplerTiming, TellsAnExpensiveTechniqueFromACheapOne) {
    SamplerTimingSettings settings;
    settings.repetitions = 15;
    settings.isa = "sse42";
    settings.configurations = {"decentral, 4 vertices"};
    const auto rows = time_samplers(settings);
    for (const char* code : {"scalar", "packs of 4, per lane"}) {
        const auto cost = [&](const char* technique) {
            return *find(rows, technique, code, "decentral, 4 vertices")->prepare_ns;
        };
        EXPECT_GT(cost("PolygonProjectedSolidAngle"), 2 * cost("PolygonArea")) << code;
    }
}

TEST(SamplerTiming, HasRatiosOfTheSameCodeAndLights) {
    const auto row = [](const char* technique, const char* lights, const char* code, double prepare,
                        double sample) {
        SamplerTiming r;
        r.technique = technique;
        r.configuration = lights;
        r.code = code;
        r.prepare_ns = prepare;
        r.sample_ns = sample;
        return r;
    };
    const char* const ours = "PolygonSolidAngle";
    const char* const published = "PolygonSolidAnglePeters";
    std::vector<SamplerTiming> rows = {row(ours, "decentral, 4 vertices", "scalar", 30, 20),
                                       row(published, "decentral, 4 vertices", "scalar", 20, 40),
                                       row(ours, "decentral, 7 vertices", "scalar", 90, 20),
                                       row(published, "decentral, 7 vertices", "scalar", 40, 40),
                                       row(ours, "decentral, 4 vertices", "packs of 4, per lane", 3, 2),
                                       row("PolygonArea", "decentral, 4 vertices", "scalar", 1, 1)};
    rows[0].prepare_instructions = 300;
    rows[1].prepare_instructions = 100;
    add_ratios(rows);
    EXPECT_EQ(rows[0].prepare_ratio, 1.5);
    EXPECT_EQ(rows[0].sample_ratio, 0.5);
    EXPECT_EQ(rows[0].prepare_instructions_ratio, 3);
    EXPECT_EQ(rows[0].sample_instructions_ratio, std::nullopt);
    EXPECT_EQ(rows[0].prepare_growth, std::nullopt) << "it has 4 vertices";
    EXPECT_EQ(rows[2].prepare_growth, 1.5) << "90 / 40 over 30 / 20";
    EXPECT_EQ(rows[2].sample_growth, 1);
    EXPECT_EQ(rows[4].prepare_ratio, std::nullopt) << "the competitor is other code";
    EXPECT_EQ(rows[5].prepare_ratio, std::nullopt) << "it has no competitor";
    EXPECT_EQ(rows[1].prepare_ratio, std::nullopt) << "it has the published formulas itself";
}

TEST(ScalarPrograms, PrintRowsOfBothCodes) {
    const std::string json = R"({"compiler": "c", "isa": "isa_generic", "rows": [
{"technique": "PolygonSolidAngle", "lights": "decentral", "vertices": 5,
 "ours_ns": {"transform": 1, "prepare": 2, "from_world": 3, "sample": 4, "direction": null, "once": 5},
 "published_ns": {"transform": 6, "prepare": 7, "from_world": 8, "sample": 9, "direction": 10, "once": 11},
 "ours_instructions": {"prepare": 12, "sample": 13}, "published_instructions": {"prepare": 14, "sample": null}}]})";
    const auto rows = scalar_rows_of(json, "g++ -O2");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].technique, "PolygonSolidAngle");
    EXPECT_EQ(rows[0].configuration, "decentral, 5 vertices");
    EXPECT_EQ(rows[0].code, "g++ -O2");
    EXPECT_EQ(rows[0].isa, "isa_generic");
    EXPECT_EQ(rows[0].prepare_ns, 2);
    EXPECT_EQ(rows[0].world_ns, 3);
    EXPECT_EQ(rows[0].direction_ns, std::nullopt);
    EXPECT_EQ(rows[0].once_ns, 5);
    EXPECT_EQ(rows[0].prepare_instructions, 12);
    EXPECT_EQ(rows[1].technique, "PolygonSolidAnglePeters");
    EXPECT_EQ(rows[1].transform_ns, 6);
    EXPECT_EQ(rows[1].direction_ns, 10);
    EXPECT_EQ(rows[1].sample_instructions, std::nullopt);
    EXPECT_THROW(scalar_rows_of("{}", "g++ -O2"), std::runtime_error);
    EXPECT_THROW(scalar_rows_of("no JSON", "g++ -O2"), std::runtime_error);
}

TEST(ScalarPrograms, MeasureTimesAndInstructions) {
    const std::filesystem::path program =
        std::filesystem::path(NUSSELT_SCALAR_PROGRAMS) / scalar_programs().front().file;
    if (!std::filesystem::exists(program)) GTEST_SKIP() << "the build has no " << program;
    const ChildResult child = run_child({program.string(), "--rows", "PolygonSolidAngle", "--instructions",
                                         "--repetitions", "11", "--json", "-"});
    const auto rows = scalar_rows_of(child.output, "g++ -O2");
    ASSERT_EQ(rows.size(), 2u);
    for (const SamplerTiming& row : rows) {
        EXPECT_TRUE(row.prepare_ns && row.world_ns && row.sample_ns && row.once_ns && row.transform_ns);
        // Four square roots and divisions take more than one nanosecond and less than a microsecond.
        EXPECT_GT(*row.prepare_ns, 1);
        EXPECT_LT(*row.prepare_ns, 10000);
        if (!row.prepare_instructions) continue; // other processors than x86-64 cannot count
        EXPECT_GT(*row.prepare_instructions, 50);
        EXPECT_LT(*row.prepare_instructions, 5000);
        EXPECT_GT(*row.sample_instructions, 30);
    }
    EXPECT_EQ(rows[0].direction_ns, std::nullopt);
    ASSERT_TRUE(rows[1].direction_ns);
}

TEST(ScalarPrograms, ThatAreMissingAreErrors) {
    EXPECT_THROW(time_scalar_program("no/such/program", "g++ -O2", 1), std::runtime_error);
}

TEST(SamplerTiming, ComparesWithPublishedFormulas) {
    EXPECT_EQ(competitor_of("PolygonSolidAngle"), "PolygonSolidAnglePeters");
    EXPECT_EQ(competitor_of("LineProjectedSolidAngle"), "LineProjectedSolidAnglePeters");
    EXPECT_EQ(competitor_of("LineSolidAngle"), "LineSolidAnglePeters");
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
