#include "lab/gpu_report/gpu_report.h"

#include "base/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace nusselt::lab {

namespace {

constexpr const char* kDevice = R"({"machine": {"processor": "a processor", "threads": 3},
"settings": {"device": "a|GPU", "kind": "discrete GPU", "driver": "d 1", "vulkan": "1.3", "clock": "c", "software": false,
"ray_queries": false, "fused_fma": true}, "tables": []})";
constexpr const char* kParity = R"({"settings": {}, "tables": [
{"name": "parity", "columns": [{"name": "subject"}, {"name": "name"}, {"name": "variant"}, {"name": "lights"},
{"name": "ratio"}, {"name": "where"}, {"name": "failures"}], "rows": [
["technique", "LineArea", "any device", 10, 1.25, "ordinary: measure, 99 %", 0],
["technique", "LineArea", "fused fma", 10, 3.5, "close: measure, 99 %", 1],
["hostile lights", "LineArea", "any device", 10, 0, "", 0]]},
{"name": "failures", "columns": [{"name": "subject"}, {"name": "name"}, {"name": "variant"}, {"name": "message"}],
"rows": [["technique", "LineArea", "fused fma", "too large"]]},
{"name": "accuracy", "columns": [{"name": "subject"}, {"name": "name"}, {"name": "variant"}, {"name": "lights"},
{"name": "quantity"}, {"name": "device"}, {"name": "cpp"}], "rows": [
["technique", "LineArea", "any device", "ordinary", "measure", 2e-7, 1e-7],
["technique", "LineArea", "any device", "close", "measure", 5e-7, 3e-7],
["technique", "LineArea", "fused fma", "close", "measure", 4e-7, 3e-7]]}]})";
constexpr const char* kAllPassed = "device passed 1 device.log\nparity passed 2 parity.log\n"
                                   "agreement passed 3 agreement.log\nsamplers passed 4 samplers.log\n"
                                   "frames passed 5 frames.log\n";
constexpr const char* kNothing = R"({"settings": {}, "tables": []})";

class GpuReportTest : public testing::Test {
protected:
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
    }

    void write_all(const std::string& steps) const {
        write("steps.txt", steps);
        write("device.json", kDevice);
        write("parity.json", kParity);
        for (const char* name : {"agreement.json", "samplers.json", "frames.json"}) write(name, kNothing);
    }

    GpuReport report() const { return report_on_gpu(folder_.path(), ""); }

    static void expect(const GpuReport& report, const std::string& line) {
        EXPECT_NE(("\n" + report.markdown).find("\n" + line + "\n"), std::string::npos) << line << "\n"
                                                                                        << report.markdown;
    }

    base::TemporaryFolder folder_;
};

TEST_F(GpuReportTest, NamesTheDeviceAndWhatItLacks) {
    write_all(kAllPassed);
    const GpuReport all = report();
    EXPECT_TRUE(all.passes) << "what a device lacks is no failure";
    expect(all, "# a|GPU");
    expect(all, "| errors of GLSL compared with C++, shaders for a fused fma | passed | 2 s |");
    expect(all, "| cost of frames, ray queries | not applicable | the driver has no ray queries |");
    const auto json = nlohmann::json::parse(all.json);
    EXPECT_EQ(json.at("passes"), true);
    EXPECT_EQ(json.at("results").at("parity").at("tables").size(), 3u);
}

TEST_F(GpuReportTest, HasTheLargestErrors) {
    write_all(kAllPassed);
    const GpuReport all = report();
    expect(all, "| LineArea | 1.2 | 3.5 | close: measure, 99 % |");
    expect(all, "| LineArea | measure | 3e-07 | 5e-07 | 4e-07 |");
    expect(all, "| parity | LineArea, fused fma | too large |");
}

TEST_F(GpuReportTest, TellsHowStepsFailed) {
    write_all("device passed 1 device.log\nparity failed 2 parity.log\nagreement late 3 agreement.log\n"
              "samplers stopped 4 samplers.log\nframes not-run 0 none\n");
    const GpuReport all = report();
    EXPECT_FALSE(all.passes);
    expect(all, "| errors of GLSL compared with C++, shaders for any device | **failed** | after 2 s, see "
                "parity.log |");
    expect(all, "| images compared with those of the CPU, rays by shaders | **failed** | no end after 3 s, "
                "see agreement.log |");
    expect(all, "| cost of samples | stopped | stopped after 4 s, see samplers.log |");
    expect(all, "| cost of frames, rays by shaders | not run | an earlier step ended the run |");
    EXPECT_EQ(nlohmann::json::parse(all.json).at("passes"), false);
}

TEST_F(GpuReportTest, TakesAStepWithoutResultsOrWithoutALineAsAFailure) {
    write_all(kAllPassed);
    write("samplers.json", "{\"settings\"");
    EXPECT_FALSE(report().passes);
    expect(report(), "| cost of samples | **failed** | after 4 s, see samplers.log |");
    write_all("device passed 1 device.log\n");
    EXPECT_FALSE(report().passes);
    write("device.json", "");
    expect(report(), "# unknown");
}

TEST_F(GpuReportTest, HasTheScenesOfStepsWithAProcessForEach) {
    write_all("device passed 1 device.log\nparity passed 2 parity.log\nagreement passed 3 agreement.log\n"
              "samplers passed 4 samplers.log\nframes failed 5 frames.log\n");
    std::filesystem::create_directory(folder_ / "frames");
    const std::string tables = R"("tables": [{"name": "failures", "columns":
[{"name": "scene"}, {"name": "message"}], "rows": [[)";
    write("frames/a.json", R"({"settings": {}, )" + tables + R"("a", "crashed"]]}]})");
    write("frames/b.json", R"({"settings": {"frames": 9}, )" + tables +
                               R"("b", "no memory"]]}, {"name": "frames", "columns": [], "rows": []}]})");
    write("frames/c.json", "{"); // the process ended while it wrote
    const GpuReport all = report();
    EXPECT_FALSE(all.passes);
    expect(all, "| frames | a | crashed |");
    expect(all, "| frames | b | no memory |");
    const auto frames = nlohmann::json::parse(all.json).at("results").at("frames");
    EXPECT_EQ(frames.at("settings").at("frames"), 9);
    EXPECT_EQ(frames.at("tables").size(), 2u);
    EXPECT_EQ(frames.at("tables").at(0).at("rows").size(), 2u);
}

TEST_F(GpuReportTest, RejectsWhatIsNoListOfSteps) {
    EXPECT_THROW(report(), std::runtime_error) << "no file";
    for (const char* line : {"device", "device fine 1 a.log", "device passed soon a.log"}) {
        write_all(line);
        EXPECT_THROW(report(), std::runtime_error) << line;
    }
    write_all(kAllPassed);
    write("parity.json", R"({"settings": {}, "tables": [{"name": "parity", "columns": [], "rows": [[1]]}]})");
    EXPECT_THROW(report(), std::runtime_error);
    EXPECT_THROW(report_on_gpu(folder_.path(), folder_ / "absent"), std::runtime_error);
}

} // namespace

} // namespace nusselt::lab
