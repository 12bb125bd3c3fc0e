// Large scenes, in small: the benchmark of scale, and what `info` says of emitters with many polygons.

#include "program.h"

#include <nlohmann/json.hpp>

namespace nusselt {
namespace {

class Scale : public CommandLine {};

TEST_F(Scale, BenchmarkMeasuresGrowingScenes) {
    const Outcome bench = run("bench scale --triangles 80000 --emissive 2000 --json -");
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    const nlohmann::json rows = nlohmann::json::parse(bench.out);
    ASSERT_EQ(rows.size(), 8u);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const nlohmann::json& row = rows[i];
        EXPECT_EQ(row["scene"], i < 4 ? "terrain" : "light");
        if (i % 4 > 0) {
            EXPECT_GT(row["triangles"], rows[i - 1]["triangles"]);
        }
        EXPECT_GT(row["load_seconds"], 0.0);
        EXPECT_GT(row["render_seconds"], 0.0);
    }
    // 2 * 200^2 triangles of 20 bytes and 201^2 vertices of 32, and hardly anything else.
    EXPECT_EQ(rows[3]["triangles"], 80000);
    EXPECT_NEAR(rows[3]["array_bytes"].get<double>(), 80000 * 20 + 40401 * 32, 2000);
    EXPECT_GT(rows[3]["load_bytes"], rows[3]["array_bytes"]);
    EXPECT_GE(rows[3]["render_bytes"], rows[3]["load_bytes"]);
}

TEST_F(Scale, BenchmarkPrintsTables) {
    const Outcome bench = run("bench scale --triangles 4000 --emissive 0");
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    EXPECT_NE(bench.out.find("Terrains"), std::string::npos) << bench.out;
    EXPECT_EQ(bench.out.find("Lights"), std::string::npos) << bench.out;
    EXPECT_NE(bench.out.find("time grows like n^"), std::string::npos) << bench.out;
    EXPECT_EQ(run("bench scale --help").exit_code, 0);
    EXPECT_EQ(run("bench scale --triangles many").exit_code, 2);
}

TEST_F(Scale, InfoSumsUpEmittersAndCountsWeakPolygons) {
    std::ofstream(path("scene.pbrt"))
        << "Camera \"perspective\" WorldBegin AreaLightSource \"diffuse\" \"rgb L\" [1 2 3]\n"
           "Shape \"trianglemesh\" \"integer indices\" [0 1 2 3 4 5]\n"
           "\"point3 P\" [0 0 0 2000 0 0 0 1000 0 5 5 1 5.001 5 1 5 5.001 1]\n";
    const Outcome info = run("info scene.pbrt");
    ASSERT_EQ(info.exit_code, 0) << info.err;
    EXPECT_NE(info.out.find("trianglemesh at scene.pbrt:2: 2 polygons, 6 vertices, 1e+06 m^2"),
              std::string::npos)
        << info.out;
    EXPECT_NE(info.out.find("1 polygons have less than 1e-06 of the power of all polygons"),
              std::string::npos)
        << info.out;
}

} // namespace
} // namespace nusselt
