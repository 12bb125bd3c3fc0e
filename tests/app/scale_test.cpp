// Large scenes, in small: the benchmark of scale, and the output of `info` for emitters with many polygons.

#include "program.h"

#include "common/results_json.h"

#include "base/isa.h"
#include "lab/timing/child_process.h"
#include "lab/timing/scale.h"

#include <cmath>

namespace nusselt {
namespace {

using lab::memory_exponent;
using lab::ScaleRow;
using lab::ScaleScene;
using lab::time_exponent;

class Scale : public CommandLine {};

TEST_F(Scale, BenchmarkMeasuresGrowingScenes) {
    const Outcome bench = run_lab("bench scale --triangles 80000 --emissive 2000 --json -");
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    const auto rows = nusselt_test::records(nlohmann::json::parse(bench.out), "scale");
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
}

TEST_F(Scale, MemoryHoldsTheArraysAndGrowsLinearly) {
    const Outcome bench = run_lab("bench scale --triangles 800000 --emissive 0 --json -");
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    const auto rows = nusselt_test::records(nlohmann::json::parse(bench.out), "scale");
    ASSERT_EQ(rows.size(), 4u);
    // Resident memory differs by some 100 kB from run to run: of this scene, loading takes 3 MB more than the arrays.
    EXPECT_GT(rows[3]["load_bytes"], rows[3]["array_bytes"]);
    EXPECT_GE(rows[3]["render_bytes"], rows[3]["load_bytes"]);
    const auto growth = [&](const char* key) {
        return std::log(rows[3][key].get<double>() / rows[2][key].get<double>());
    };
    EXPECT_LT(growth("render_bytes") / growth("triangles"), 1.1) << bench.out;
}

TEST(ScaleExponents, AreThoseOfPowers) {
    // Only the last two rows count. For n = 1e3 and 1e5: load n^1, hierarchy n^1, rendering n^2, memory n^1.5.
    const auto row = [](ScaleScene scene, double n) {
        return ScaleRow{scene,    static_cast<std::uint64_t>(n),
                        0,        1e-6 * n,
                        2e-6 * n, 1e-9 * n * n,
                        0,        static_cast<std::uint64_t>(std::llround(std::pow(n, 1.5)))};
    };
    const std::vector<ScaleRow> terrain = {row(ScaleScene::terrain, 10), row(ScaleScene::terrain, 1e3),
                                           row(ScaleScene::terrain, 1e5)};
    EXPECT_NEAR(time_exponent(terrain).value(), 1, 1e-9);
    EXPECT_NEAR(memory_exponent(terrain).value(), 1.5, 1e-5);
    const std::vector<ScaleRow> light = {row(ScaleScene::light, 1e3), row(ScaleScene::light, 1e5)};
    // The time grows from 0.003 + 0.001 to 0.3 + 10 seconds.
    EXPECT_NEAR(time_exponent(light).value(), std::log(10.3 / 0.004) / std::log(100), 1e-9);
}

TEST(ScaleExponents, AreNothingWhereRowsDoNotTell) {
    const ScaleRow row = {ScaleScene::light, 8, 0, 1, 1, 1, 1, 1};
    EXPECT_FALSE(time_exponent({}));
    EXPECT_FALSE(time_exponent({row}));
    EXPECT_FALSE(time_exponent({row, row}));
    EXPECT_FALSE(memory_exponent({row, row}));
    ScaleRow larger = row;
    larger.triangles = 80;
    EXPECT_EQ(memory_exponent({row, larger}), 0.0);
    larger.render_bytes = 0;
    EXPECT_FALSE(memory_exponent({row, larger}));
    EXPECT_FALSE(memory_exponent({larger, row}));
}

TEST_F(Scale, BenchmarkPrintsTables) {
    const Outcome bench = run_lab("bench scale --triangles 4000 --emissive 0");
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    EXPECT_NE(bench.out.find("Terrains"), std::string::npos) << bench.out;
    EXPECT_EQ(bench.out.find("Lights"), std::string::npos) << bench.out;
    EXPECT_NE(bench.out.find("time grows like n^"), std::string::npos) << bench.out;
    EXPECT_EQ(run_lab("bench scale --help").exit_code, 0);
    for (const char* count : {"many", "-1", "0.5", "1000000001"})
        EXPECT_EQ(run_lab(std::string("bench scale --triangles ") + count).exit_code, 2) << count;
    EXPECT_EQ(run_lab("bench scale --emissive -1").exit_code, 2);
    const Outcome tiny = run_lab("bench scale --triangles 8 --emissive 0");
    EXPECT_EQ(tiny.exit_code, 0) << tiny.err;
    EXPECT_NE(tiny.out.find("too few triangles"), std::string::npos) << tiny.out;
}

/// Square lights, each an emitter of its own.
void write_many_lights(const std::string& path, int count) {
    std::ofstream scene(path);
    scene << "Camera \"perspective\"\nWorldBegin\n";
    for (int i = 0; i < count; ++i)
        scene << "AttributeBegin\nAreaLightSource \"diffuse\"\nTranslate " << i % 100 << " " << i / 100
              << " 5\nShape \"trianglemesh\" \"point3 P\" [0 0 0 .4 0 0 .4 .4 0 0 .4 0] "
                 "\"integer indices\" [0 1 2 0 2 3]\nAttributeEnd\n";
}

/// Memory in use, not what the renderer believes to need: of the layers, working memory and the writing of the file. The
/// smaller the image, the larger the share of names and sums; this one has a single tile, hence sums of one thread.
TEST_F(Scale, LayersTakeTheMemoryThatIsAnnounced) {
    constexpr int kLights = 20'000;
    write_many_lights(path("scene.pbrt"), kLights);
    // With AVX-512, sums of twice as many lanes take another 8 % of the layers; so do those of several camera rays.
    const std::string isa = is_supported(base::Isa::avx2) ? "avx2" : "sse42";
    const auto render = [&](const std::string& layers) {
        return lab::run_child({"/bin/sh", "-c",
                               "exec '" + std::string(kProgram) + "' render '" + path("scene.pbrt") +
                                   "' --resolution 16x12 --isa " + isa + " -o '" + path("a.exr") + "' " +
                                   layers + " 2>&1"});
    };
    const lab::ChildResult with = render("--layers lights");
    const double bytes = static_cast<double>(with.peak_bytes) - static_cast<double>(render("").peak_bytes);
    const double raw_bytes = 16.0 * 12 * 3 * sizeof(float) * kLights;
    EXPECT_LT(bytes, 1.2 * raw_bytes);
    EXPECT_GT(bytes, raw_bytes);
    const std::string need = "need ";
    ASSERT_NE(with.output.find(need), std::string::npos) << with.output;
    const double announced = 1e6 * std::stod(with.output.substr(with.output.find(need) + need.size()));
    EXPECT_NE(with.output.find(" MB of memory for 16 x 12 pixels"), std::string::npos) << with.output;
    EXPECT_NEAR(announced, bytes, 0.1 * bytes);
}

/// At most 0.4 GB for a million lights.
TEST_F(Scale, InfoOfManyLightsTakesLittleMemory) {
    const auto peak_bytes = [&](int lights) {
        write_many_lights(path("scene.pbrt"), lights);
        const lab::ChildResult info = lab::run_child({kProgram, "info", path("scene.pbrt")});
        EXPECT_NE(info.output.find(std::to_string(lights) + " polygon light"), std::string::npos);
        return static_cast<double>(info.peak_bytes);
    };
    EXPECT_LT(peak_bytes(100'000) - peak_bytes(1), 40e6);
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
    EXPECT_NE(info.out.find("1 of the polygons has less than 1e-06 of the power of all"), std::string::npos)
        << info.out;
}

} // namespace
} // namespace nusselt
