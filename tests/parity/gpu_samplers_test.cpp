#include "gpu_test.h"
#include "lab/timing/gpu_samplers.h"
#include "proof/techniques/registry.h"

#include <cmath>
#include <map>
#include <set>

namespace nusselt::parity {

namespace {

TEST(GpuSamplerRows, AreMediansLessTheBaseline) {
    const auto rows = lab::rows_of({{"Baseline", "lines", {1, 3, 2}, {4, 5, 6}},
                                    {"LineArea", "lines", {10, 12, 14}, {8, 8, 8}},
                                    {"Baseline", "polygons", {0, 0, 0}, {0, 0, 0}},
                                    {"PolygonArea", "polygons", {7, 7, 7}, {1, 1, 1}}});
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].technique, "LineArea");
    EXPECT_EQ(rows[0].configuration, "lines");
    EXPECT_EQ(rows[0].light_ns, 10);
    EXPECT_EQ(rows[0].sample_ns, 3);
    EXPECT_EQ(rows[0].light_spread, 1.0 / 12) << "half of 14 - 12, relative to 12";
    EXPECT_EQ(rows[0].sample_spread, 0);
    EXPECT_EQ(rows[1].technique, "PolygonArea");
    EXPECT_EQ(rows[1].light_ns, 7) << "minus the baseline of the same lights";
}

TEST(GpuSamplerRows, HaveRatiosOfTimesAboveTheBaseline) {
    const auto rows = lab::rows_of({{"Baseline", "any", {2}, {2}},
                                    {"LineProjectedSolidAnglePeters", "any", {6}, {2}},
                                    {"LineProjectedSolidAngle", "any", {4}, {3}},
                                    {"LineArea", "any", {3}, {3}},
                                    {"Baseline", "other", {2}, {2}},
                                    {"LineProjectedSolidAngle", "other", {4}, {3}}});
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[1].light_ratio, 0.5);
    EXPECT_EQ(rows[1].sample_ratio, std::nullopt) << "the competitor takes no time above the baseline";
    EXPECT_EQ(rows[2].light_ratio, std::nullopt) << "no competitor";
    EXPECT_EQ(rows[3].light_ratio, std::nullopt) << "no competitor with these lights";
}

TEST(GpuSamplerRows, CompareSamplesWithDensityAndPoint) {
    const auto rows = lab::rows_of({{"Baseline", "any", {1}, {1}},
                                    {"LineSolidAnglePeters", "any", {5}, {5}},
                                    {"LineSolidAnglePeters", "any", {3}, {3}, true},
                                    {"LineSolidAngle", "any", {9}, {3}}});
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_TRUE(rows[1].directions);
    EXPECT_EQ(rows[1].light_ns, 2);
    EXPECT_EQ(rows[2].light_ratio, 2) << "not over directions alone";
    EXPECT_EQ(rows[2].sample_ratio, 0.5);
}

class GpuSamplers : public GpuTest {};

/// The name of the suite in techniques.json.
struct GpuTimingSuite {
    static constexpr std::string_view kName = "gpu_timing";
};

TEST_F(GpuSamplers, HaveARowForEachTechniqueAndClassOfLights) {
    const auto table = lab::time_gpu_samplers({.repetitions = 1});
    EXPECT_EQ(table.device.name, device().description().name);
    EXPECT_EQ(table.llvmpipe_threads.has_value(), table.device.name.find("llvmpipe") != std::string::npos);
    std::map<std::string, std::set<std::string>> lights, lights_of_directions;
    for (const auto& row : table.rows) {
        EXPECT_TRUE(
            (row.directions ? lights_of_directions : lights)[row.technique].insert(row.configuration).second)
            << row.technique << " has two rows for " << row.configuration;
        EXPECT_TRUE(std::isfinite(row.light_ns) && std::isfinite(row.sample_ns)) << row.technique;
    }
    const auto expect_rows = [&](auto list, std::size_t count, const char* what) {
        list.for_each([&]<class Kind> {
            EXPECT_EQ(lights[Kind::kName].size(), count) << Kind::kName << ": " << what;
            if (*Kind::kPublishedName != '\0') {
                EXPECT_EQ(lights[Kind::kPublishedName].size(), count) << Kind::kPublishedName;
                EXPECT_EQ(lights_of_directions[Kind::kPublishedName].size(),
                          hostile::kIsPolygon<Kind> ? 3u : 2u)
                    << Kind::kPublishedName << ": each class, polygons with 4 vertices";
            }
        });
    };
    using namespace hostile;
    expect_rows(PolygonKinds<5>(), 15, "three classes with 3 to 7 vertices");
    expect_rows(TestedBy<GpuTimingSuite, RelatedPolygonKinds, RectangleKinds>(), 3,
                "three classes with 4 vertices");
    expect_rows(TestedBy<GpuTimingSuite, PolygonOnLobeKinds<4>, LineKinds, LineOnLobeKinds, CylinderKinds,
                         CylinderOnLobeKinds, RoundKinds, RoundOnLobeKinds>(),
                2, "two classes");
}

TEST_F(GpuSamplers, NameAnUnknownDevice) {
    EXPECT_THROW(lab::time_gpu_samplers({.repetitions = 1, .device = "no such device"}), gpu::NoDevice);
}

} // namespace

} // namespace nusselt::parity
