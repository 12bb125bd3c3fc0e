#include "experiments/gpu_samplers.h"
#include "gpu_test.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace nusselt::parity {

namespace {

class GpuSamplers : public GpuTest {};

TEST_F(GpuSamplers, HaveARowForEachTechniqueAndClassOfLights) {
    const auto table = experiments::time_gpu_samplers({.repetitions = 3});
    EXPECT_EQ(table.device.name, device().description().name);
    std::map<std::string, std::set<std::string>> lights;
    for (const auto& row : table.rows) {
        lights[row.technique].insert(row.configuration);
        EXPECT_TRUE(std::isfinite(row.light_ns) && std::isfinite(row.sample_ns)) << row.technique;
    }
    for (const char* technique :
         {"PolygonArea", "PolygonSolidAngle", "PolygonClippedSolidAngle", "PolygonProjectedSolidAngle",
          "PolygonProjectedSolidAngleBiased", "PolygonSolidAnglePeters", "PolygonProjectedSolidAnglePeters"})
        EXPECT_EQ(lights[technique].size(), 15u) << technique << ": three classes with 3 to 7 vertices";
    for (const char* technique : {"LineArea", "LineSolidAngle", "LineClippedSolidAngle",
                                  "LineProjectedSolidAngle", "LineProjectedSolidAnglePeters"})
        EXPECT_EQ(lights[technique].size(), 2u) << technique;

    const auto row_of = [&](const char* technique) {
        return *std::find_if(table.rows.begin(), table.rows.end(), [&](const auto& row) {
            return row.technique == technique && row.configuration == "decentral, 4 vertices";
        });
    };
    // The work per light is many times that of area sampling, and includes a sample.
    EXPECT_GT(row_of("PolygonProjectedSolidAngle").light_ns, 2 * row_of("PolygonArea").light_ns);
    EXPECT_GT(row_of("PolygonProjectedSolidAngle").light_ns, row_of("PolygonProjectedSolidAngle").sample_ns);
    EXPECT_GT(row_of("PolygonProjectedSolidAngle").sample_ratio, 0);
}

TEST_F(GpuSamplers, NameAnUnknownDevice) {
    EXPECT_THROW(experiments::time_gpu_samplers({.repetitions = 1, .device = "no such device"}),
                 gpu::NoDevice);
}

} // namespace

} // namespace nusselt::parity
