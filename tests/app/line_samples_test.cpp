// `nusselt render --light-samples lines` as a user sees it.

#include "program.h"

#include "image/io.h"
#include "image/layers.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace nusselt {

namespace {

const std::string kRender = "render '" + kScenes + "/cornell-panel.pbrt' --resolution 24x24 -q ";

nlohmann::json report_of(const Outcome& rendered) {
    EXPECT_EQ(rendered.exit_code, 0) << rendered.err;
    return nlohmann::json::parse(rendered.out);
}

TEST_F(CommandLine, RendersWithLines) {
    const auto report =
        report_of(run(kRender + "--light-samples lines --lines 3 --orientation fixed --offsets uniform "
                                "--line-shading analytic --many-occluders lines --pixel-center "
                                "-o lines.exr --json -"));
    EXPECT_EQ(report["light_samples"], "lines");
    EXPECT_TRUE(report["rays_per_second"].is_null());
    const auto& lines = report["line_samples"];
    EXPECT_EQ(lines["lines"], 3);
    EXPECT_EQ(lines["orientation"], "fixed");
    EXPECT_EQ(lines["offsets"], "uniform");
    EXPECT_EQ(lines["line_shading"], "analytic");
    EXPECT_EQ(lines["many_occluders"], "lines");
    EXPECT_GT(lines["lights_with_lines"], 0);
    EXPECT_EQ(lines["lights_with_points"], 0);
    EXPECT_EQ(lines["traced_lines"], 3 * lines["lights_with_lines"].get<int>());
    EXPECT_GT(lines["box_tests"], 0);

    const auto metadata = image::read_layers(path("lines.exr")).metadata;
    EXPECT_EQ(metadata.at("integrator"), "lines");
    EXPECT_EQ(metadata.at("lines"), "3");
    EXPECT_EQ(metadata.at("orientation"), "fixed");
    EXPECT_EQ(metadata.at("offsets"), "uniform");
    EXPECT_EQ(metadata.at("line_shading"), "analytic");
    EXPECT_EQ(metadata.at("many_occluders"), "lines");

    const auto points = report_of(run(kRender + "-o points.exr --json -"));
    EXPECT_EQ(points["light_samples"], "points");
    EXPECT_GT(points["rays_per_second"], 0.0);
    EXPECT_TRUE(points["line_samples"].is_null());
    EXPECT_EQ(image::read_layers(path("points.exr")).metadata.count("lines"), 0u);
}

TEST_F(CommandLine, RefusesOptionsThatLinesHaveNoUseFor) {
    for (const char* option : {"--lines 4", "--orientation fixed", "--offsets uniform",
                               "--line-shading analytic", "--many-occluders lines", "--layers pieces"}) {
        const Outcome wrong = run(kRender + option);
        EXPECT_EQ(wrong.exit_code, 2) << option;
        expect_message(wrong.err, "--light-samples lines");
    }
    const Outcome analytic = run(kRender + "--light-samples lines --technique ltc_analytic");
    EXPECT_EQ(analytic.exit_code, 2);
    expect_message(analytic.err, "ltc_analytic");
    for (const char* option : {"--lines 0", "--lines 65537", "--orientation up", "--offsets width"}) {
        const Outcome wrong = run(kRender + "--light-samples lines " + option);
        EXPECT_EQ(wrong.exit_code, 2) << option;
        expect_message(wrong.err, "--help");
    }
}

TEST_F(CommandLine, WarnsOfTheOldNameOfLightSamples) {
    const std::string render = "render '" + kScenes + "/cornell-panel.pbrt' --resolution 8x8 -o old.exr ";
    const Outcome old_name = run(render + "--integrator lines --lines 16");
    EXPECT_EQ(old_name.exit_code, 0);
    EXPECT_NE(old_name.err.find("--integrator is now called --light-samples"), std::string::npos)
        << old_name.err;
    EXPECT_EQ(image::read_layers(path("old.exr")).metadata.at("integrator"), "lines");
    EXPECT_EQ(run(render + "--integrator lines --light-samples lines").exit_code, 2);
    EXPECT_EQ(run(render + "--integrator planes").exit_code, 2);
    EXPECT_EQ(run("render --help").out.find("--integrator"), std::string::npos);
}

TEST_F(CommandLine, WarnsThatFewLinesAreReplacedByPoints) {
    const std::string render = "render '" + kScenes + "/cornell-panel.pbrt' --resolution 8x8 -o few.exr ";
    const std::string few = render + "--light-samples lines --lines 8";
    const Outcome warned = run(few);
    EXPECT_EQ(warned.exit_code, 0);
    EXPECT_NE(warned.err.find("use --many-occluders lines to keep lines"), std::string::npos) << warned.err;
    EXPECT_EQ(run(few + " --many-occluders lines").err.find("warning"), std::string::npos);
    EXPECT_EQ(run(render + "--light-samples lines --lines 16").err.find("warning"), std::string::npos);
}

TEST_F(CommandLine, PrintsItsVersion) {
    const Outcome version = run("--version");
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_EQ(version.out.rfind("nusselt ", 0), 0u) << version.out;
}

TEST_F(CommandLine, PartsOfLineSamplesMergeToTheWholeImage) {
    const std::string lines =
        kRender + "--light-samples lines --lines 2 --many-occluders lines --layers all --spp 2 ";
    ASSERT_EQ(run(lines + "-o whole.exr").exit_code, 0);
    ASSERT_EQ(run(lines + "--part 1/2 -o 1.exr").exit_code, 0);
    ASSERT_EQ(run(lines + "--part 2/2 -o 2.exr").exit_code, 0);
    const Outcome merged = run("merge -o merged.exr 1.exr 2.exr");
    ASSERT_EQ(merged.exit_code, 0) << merged.err;
    const Outcome same = run("compare merged.exr whole.exr --max mse=0");
    EXPECT_EQ(same.exit_code, 0) << same.out << same.err;

    ASSERT_EQ(run(lines + "--part 2/2 --offsets uniform -o other.exr").exit_code, 0);
    const Outcome refused = run("merge -o wrong.exr 1.exr other.exr");
    EXPECT_EQ(refused.exit_code, 1);
    expect_message(refused.err, "offsets");
}

} // namespace

} // namespace nusselt
