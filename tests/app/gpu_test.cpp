/// The program with a GPU, and without one.

#include "program.h"

#include "common/results_json.h"

#include "image/io.h"

#include <set>

namespace nusselt {

namespace {

constexpr const char* kNoDriver = "VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent";

class Gpu : public CommandLine {};

TEST_F(Gpu, BenchmarkWritesATableAsJson) {
    const Outcome bench = run_lab("bench gpu '" + kScenes +
                                  "/cornell-tube.pbrt' --resolution 24x16 --frames 3 --warm-up 1 "
                                  "--techniques ltc_analytic --json -");
    if (lacks_device(bench)) GTEST_SKIP() << bench.err;
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    const auto json = nlohmann::json::parse(bench.out);
    const auto& settings = json.at("settings");
    for (const char* text : {"device", "kind", "driver", "vulkan", "clock"})
        EXPECT_FALSE(settings.at(text).get<std::string>().empty()) << text;
    EXPECT_EQ(settings.at("software"), settings.at("kind") == "CPU");
    EXPECT_EQ(settings.at("frames"), 3);
    EXPECT_EQ(nusselt_test::records(json, "failures").size(), 0u);
    std::multiset<std::string> rows;
    for (const auto& row : nusselt_test::records(json, "frames")) {
        EXPECT_EQ(row.at("width"), 24);
        EXPECT_EQ(row.at("height"), 16);
        EXPECT_EQ(row.at("technique"), "ltc_analytic");
        EXPECT_EQ(row.at("samples"), 2);
        EXPECT_EQ(row.at("shadow_rays"), 0);
        EXPECT_GT(row.at("visibility_ms"), 0.0);
        EXPECT_GT(row.at("shading_ms"), 0.0);
        EXPECT_GE(row.at("frame_ms"), row.at("shading_ms"));
        rows.insert(row.at("scene"));
    }
    EXPECT_EQ(rows,
              (std::multiset<std::string>{"cornell-tube", "cornell-tube", "cornell-tube, a line as light",
                                          "cornell-tube, a quad as light"}));
    const auto ratios = nusselt_test::records(json, "ratios");
    ASSERT_EQ(ratios.size(), 1u);
    EXPECT_GT(ratios[0].at("shading"), 0.0);
    EXPECT_NEAR(ratios[0].at("published"), 0.724, 0.001);
}

TEST_F(Gpu, BenchmarkNamesTheDeviceAndWhatItCannotMeasure) {
    const Outcome bench =
        run_lab("bench gpu no-such-scene.pbrt '" + kScenes +
                "/cornell-panel.pbrt' --resolution 24x16 --frames 1 --warm-up 0 --techniques "
                "ltc_analytic --shadow-rays none --json table.json");
    if (lacks_device(bench)) GTEST_SKIP() << bench.err;
    EXPECT_EQ(bench.exit_code, 1) << "one of two scenes";
    EXPECT_NE(bench.err.find("no-such-scene.pbrt"), std::string::npos) << bench.err;
    const auto json = nlohmann::json::parse(read("table.json"));
    const auto failures = nusselt_test::records(json, "failures");
    ASSERT_EQ(failures.size(), 1u);
    EXPECT_EQ(failures[0].at("scene"), "no-such-scene");
    EXPECT_EQ(nusselt_test::records(json, "frames").size(), 1u);
    const auto& settings = json.at("settings");
    for (const std::string& text :
         {settings.at("device").get<std::string>(), settings.at("driver").get<std::string>(),
          std::string("ltc_analytic"), std::string("cornell-panel, 24 x 16")})
        EXPECT_NE(bench.out.find(text), std::string::npos) << text << " in\n" << bench.out;
    EXPECT_EQ(bench.out.find("software device") != std::string::npos, settings.at("software").get<bool>());
}

TEST_F(Gpu, BenchmarkRefusesWrongUse) {
    for (const char* arguments :
         {"--frames 0", "--resolution 0x4", "--techniques magic", "--shadow-rays some"}) {
        const Outcome wrong = run_lab(std::string("bench gpu ") + arguments);
        if (lacks_device(wrong)) GTEST_SKIP() << wrong.err;
        EXPECT_EQ(wrong.exit_code, 2) << arguments;
        expect_lab_message(wrong.err, "--help");
    }
}

TEST_F(Gpu, BenchmarkWithoutADriverSaysWhatIsMissing) {
    const Outcome bench = run_lab("bench gpu '" + kScenes + "/room.pbrt'", kNoDriver);
    EXPECT_EQ(bench.exit_code, 1);
    expect_lab_message(bench.err, "install");
}

TEST_F(Gpu, WithoutADriverAutoRendersOnTheCpu) {
    const std::string render = "render '" + kScenes + "/cornell-tube.pbrt' --resolution 32x32 --json - -q ";
    const Outcome automatic = run(render + "--backend auto -o auto.exr", kNoDriver);
    ASSERT_EQ(automatic.exit_code, 0) << automatic.err;
    EXPECT_EQ(automatic.err, "") << "with -q";
    EXPECT_TRUE(nlohmann::json::parse(automatic.out).contains("isa")) << "of the CPU";
    ASSERT_EQ(run(render + "--backend cpu -o cpu.exr").exit_code, 0);
    EXPECT_EQ(image::read_image(path("auto.exr")).pixels, image::read_image(path("cpu.exr")).pixels);

    const Outcome vulkan = run(render + "--backend vulkan -o vulkan.exr", kNoDriver);
    EXPECT_EQ(vulkan.exit_code, 1);
    expect_message(vulkan.err, "install");
    EXPECT_FALSE(std::filesystem::exists(path("vulkan.exr")));
}

TEST_F(Gpu, AutoOnTheCpuDoesNotAdviseTheCpu) {
    const auto [tube, street] = std::pair("cornell-tube.pbrt", "street.pbrt");
    for (const auto& [scene, options, reason] :
         {std::tuple(tube, "--layers normal", "layer normal is not supported on GPUs"),
          std::tuple(tube, "--light-samples lines", "--light-samples lines is not supported on GPUs"),
          std::tuple(street, "--technique ltc_analytic --strategies diffuse",
                     "--technique ltc_analytic is not supported on GPUs for lights with a profile, a spread "
                     "or a honeycomb")}) {
        const std::string render = "render '" + kScenes + '/' + scene + "' --resolution 8x8 -o a.exr ";
        const Outcome automatic = run(render + "--backend auto " + options, kNoDriver);
        EXPECT_EQ(automatic.exit_code, 0) << automatic.err;
        EXPECT_NE(automatic.err.find("rendering on the CPU: "), std::string::npos) << automatic.err;
        EXPECT_EQ(automatic.err.find("--backend"), std::string::npos) << automatic.err;
        const Outcome vulkan = run(render + "--backend vulkan " + options);
        if (lacks_device(vulkan)) continue;
        EXPECT_EQ(vulkan.exit_code, 1);
        expect_message(vulkan.err, std::string(reason) + "; use --backend cpu");
        const Outcome with_device = run(render + "--backend auto --device 0 " + options);
        EXPECT_EQ(with_device.exit_code, 0) << with_device.err;
        EXPECT_NE(with_device.err.find("rendering on the CPU: " + std::string(reason)), std::string::npos)
            << with_device.err;
    }
}

} // namespace

} // namespace nusselt
