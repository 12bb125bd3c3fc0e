#include "base/temporary_folder.h"
#include "common/source_folder.h"
#include "image/io.h"
#include "image/srgb.h"
#include "lab/peers/peer_comparison.h"
#include "lab/report/report_folder.h"
#include "lab/round/round_comparison.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

namespace nusselt::lab {

namespace {

using nusselt::base::TemporaryFolder;

std::string contents(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Report, WhatWasNotEvaluatedIsNoPass) {
    const ExpectationResult holds = checked("a", true), fails = checked("b", false),
                            open = not_evaluated("c", "no scene");
    EXPECT_EQ(verdict_of({}), Verdict::holds);
    EXPECT_EQ(verdict_of({holds, holds}), Verdict::holds);
    EXPECT_EQ(verdict_of({holds, open}), Verdict::not_evaluated);
    EXPECT_EQ(verdict_of({open, fails, holds}), Verdict::fails);
    EXPECT_EQ(to_text({holds, fails, open}), "holds: a\nDOES NOT HOLD: b\nNOT EVALUATED (no scene): c\n");
}

TEST(Report, ExperimentsHaveUniqueNamesThatArePartsOfPaths) {
    std::set<std::string> names;
    for (const Experiment& e : all_experiments()) {
        EXPECT_TRUE(names.insert(e.name).second) << e.name;
        EXPECT_EQ(file_stem(e.name), e.name);
        EXPECT_FALSE(e.source.empty());
        EXPECT_FALSE(e.description.empty());
    }
}

// Whoever renames or drops an experiment sees which figures lose it. Comparisons with other renderers, and of round lights, are about none of
// these papers.
TEST(Report, EveryExperimentShowsAnItemOfThePapers) {
    std::ifstream file(std::filesystem::path(nusselt_test::kSourceFolder) / "lab/report/published.json");
    const auto published = nlohmann::json::parse(file);
    std::set<std::string> named;
    for (const auto& paper : published.at("papers"))
        for (const auto& item : paper.at("items")) {
            for (const std::string name : item.at("by")) named.insert(name);
        }
    std::set<std::string> others;
    for (const PeerComparison& comparison : all_peer_comparisons()) others.insert(comparison.name);
    for (const RoundComparison& comparison : all_round_comparisons()) others.insert(comparison.name);
    for (const Experiment& e : all_experiments()) {
        EXPECT_EQ(named.count(e.name), others.count(e.name) > 0 ? 0u : 1u) << e.name << " shows nothing";
    }
}

TEST(Report, FileStemsHaveNoSpecialCharacters) {
    EXPECT_EQ(file_stem("points, by importance"), "points-by-importance");
    EXPECT_EQ(file_stem("../A b_C/.."), "A-b_C-");
}

/// The bytes of a PNG, from the linear values that its transfer function makes of them.
std::vector<int> codes_of(const image::Image& image) {
    std::vector<int> codes;
    for (const float value : image.pixels)
        codes.push_back(
            static_cast<int>(std::lround(255 * image::srgb_from_linear(static_cast<double>(value)))));
    return codes;
}

TEST(Report, RgbeKeepsEightBitsOfTheLargestChannel) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::vector<float> pixels = {1, 0.5f,      0.25f, 1e-3f,  2e-3f, 1e4f,   0,   0,
                                       0, -1,        3,     255.9f, 1,     2,      NAN, 1,
                                       2, kInfinity, 1,     1,      1e-9f, 1e-38f, 0,   0};
    const image::Image image = {4, 2, pixels};
    const TemporaryFolder folder;
    std::ofstream(folder / "a.png", std::ios::binary) << rgbe_stacked_png(image);
    const image::Image stacked = image::read_image(folder / "a.png");
    ASSERT_EQ(stacked.width, 4);
    ASSERT_EQ(stacked.height, 4);
    const std::vector<int> codes = codes_of(stacked);
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
        const float* const rgb = &pixels[i];
        const int exponent = codes[pixels.size() + i];
        for (std::size_t c = 1; c < 3; ++c) EXPECT_EQ(codes[pixels.size() + i + c], exponent);
        if (!std::isfinite(rgb[0] + rgb[1] + rgb[2])) {
            EXPECT_EQ(exponent, 255) << i;
            continue;
        }
        const double largest = std::max({0.0, double(rgb[0]), double(rgb[1]), double(rgb[2])});
        EXPECT_EQ(exponent == 0, largest == 0) << i;
        for (std::size_t c = 0; c < 3; ++c) {
            const double decoded = exponent > 0 ? std::ldexp(codes[i + c] + 0.5, exponent - 136) : 0;
            EXPECT_NEAR(decoded, std::max(double(rgb[c]), 0.0), largest / 256 * 1.0001) << i << " " << c;
        }
    }
}

/// An experiment whose result is a number, and which counts its runs.
struct Sample {
    TemporaryFolder folder;
    std::filesystem::path input = folder / "scene.txt";
    std::filesystem::path out = folder / "out";
    Experiment experiment = {"sample", "A paper", "</script><b>", {}};
    RunRecord record = {"nusselt-lab reproduce sample", "2001-02-03T04:05:06Z", 1};
    RunSettings settings = {"scenes", Effort::quick, 1};

    Sample() { std::ofstream(input) << "one"; }
    Report report(Verdict verdict) const {
        Report report = {"", {{{"a"}, {"b"}}}, {{"text", verdict, "reason"}}};
        report.numbers = {"sample", {}, {}};
        report.inputs = {input};
        return report;
    }
};

TEST(ReportFolder, KeepsReportsWhileNothingChanges) {
    const Sample sample;
    const ReportFolder folder(sample.out);
    EXPECT_FALSE(folder.kept(sample.experiment, sample.settings));
    for (const Verdict verdict : {Verdict::fails, Verdict::not_evaluated, Verdict::holds}) {
        folder.write(sample.experiment, sample.report(verdict), sample.settings, sample.record);
        const auto kept = ReportFolder(sample.out).kept(sample.experiment, sample.settings);
        ASSERT_TRUE(kept);
        EXPECT_EQ(kept->verdict, verdict);
        EXPECT_EQ(kept->date, sample.record.date);
    }
    for (const RunSettings& settings :
         {RunSettings{"scenes", Effort::full, 1}, RunSettings{"elsewhere", Effort::quick, 1},
          RunSettings{"scenes", Effort::quick, 2}})
        EXPECT_FALSE(folder.kept(sample.experiment, settings));
    Experiment other = sample.experiment;
    other.name = "other";
    EXPECT_FALSE(folder.kept(other, sample.settings));
}

TEST(ReportFolder, AFullReportCountsAsAQuickOne) {
    const Sample sample;
    const ReportFolder folder(sample.out);
    const RunSettings full = {"scenes", Effort::full, 1};
    folder.write(sample.experiment, sample.report(Verdict::holds), full, sample.record);
    EXPECT_TRUE(folder.kept(sample.experiment, full));
    EXPECT_TRUE(folder.kept(sample.experiment, sample.settings));
}

/// The sections of the page with all experiments of a sample.
nlohmann::json sections_of(const Sample& sample, const ReportFolder& folder) {
    const std::string page = contents(folder.write_page({sample.experiment}));
    const std::string begin = "id=\"report\">";
    const std::string text = page.substr(page.find(begin) + begin.size());
    return nlohmann::json::parse(text.substr(0, text.find("</script>"))).at("experiments");
}

TEST(ReportFolder, QuickReportsLeaveFullOnesAlone) {
    const Sample sample;
    const RunSettings full = {"scenes", Effort::full, 1};
    const ReportFolder folder(sample.out);
    folder.write(sample.experiment, sample.report(Verdict::holds), full, sample.record);

    // As after a change of the program: the full report is out of date, and a quick one takes over.
    std::ofstream(sample.input) << "another";
    EXPECT_FALSE(folder.kept(sample.experiment, sample.settings));
    RunRecord later = sample.record;
    later.date = "2001-02-03T04:05:07Z";
    folder.write(sample.experiment, sample.report(Verdict::fails), sample.settings, later);
    EXPECT_EQ(folder.kept(sample.experiment, sample.settings)->date, later.date);
    EXPECT_FALSE(folder.kept(sample.experiment, full));
    const auto both = sections_of(sample, folder);
    ASSERT_EQ(both.size(), 1u);
    EXPECT_EQ(both[0].at("effort"), "full");
    EXPECT_EQ(both[0].at("date"), sample.record.date);
    EXPECT_EQ(both[0].at("expectations")[0].at("state"), "holds");
    EXPECT_EQ(both[0].at("later").at("date"), later.date);
    EXPECT_EQ(both[0].at("later").at("expectations")[0].at("state"), "fails");

    // A full run that comes after it says all.
    later.date = "2001-02-03T04:05:08Z";
    folder.write(sample.experiment, sample.report(Verdict::holds), full, later);
    EXPECT_FALSE(sections_of(sample, folder)[0].contains("later"));
    EXPECT_EQ(folder.kept(sample.experiment, sample.settings)->date, later.date);

    // A damaged full report hides no quick one.
    std::ofstream(sample.out / "sample/full/section.json") << "{";
    EXPECT_EQ(sections_of(sample, folder)[0].at("effort"), "quick");
}

TEST(ReportFolder, ThePageSaysWhatTheMachineLacks) {
    Sample sample;
    sample.experiment.obstacle = [] { return "a renderer is missing"; };
    const ReportFolder folder(sample.out);
    EXPECT_NE(contents(folder.write_page({sample.experiment})).find("a renderer is missing"),
              std::string::npos);
    folder.write(sample.experiment, sample.report(Verdict::holds), sample.settings, sample.record);
    EXPECT_EQ(sections_of(sample, folder).size(), 1u); // what an earlier run found remains
}

TEST(ReportFolder, ForgetsReportsOfOtherInputsAndDamagedOnes) {
    const Sample sample;
    const ReportFolder folder(sample.out);
    const auto write = [&] {
        std::ofstream(sample.input) << "one";
        folder.write(sample.experiment, sample.report(Verdict::holds), sample.settings, sample.record);
        ASSERT_TRUE(folder.kept(sample.experiment, sample.settings));
    };
    const auto forgot = [&] { return !folder.kept(sample.experiment, sample.settings); };
    write();
    std::ofstream(sample.input) << "two";
    EXPECT_TRUE(forgot());
    write();
    std::filesystem::remove(sample.input);
    EXPECT_TRUE(forgot());
    for (const char* state : {"", "{", "[]", "{\"key\": 1}", "null"}) {
        write();
        std::ofstream(sample.out / "sample/quick/state.json") << state;
        EXPECT_TRUE(forgot()) << state;
    }
    write();
    for (const char* section : {"", "{", "[]", "null", "{\"name\": 1}"}) {
        write();
        std::ofstream(sample.out / "sample/quick/section.json") << section;
        EXPECT_TRUE(forgot()) << section;
        const std::string page = contents(folder.write_page({sample.experiment}));
        EXPECT_NE(page.find("\"not_run\": [{\"name\":\"sample\""), std::string::npos) << section;
    }
    for (const char* file : {"section.json", "numbers.json"}) {
        write();
        std::filesystem::remove(sample.out / "sample/quick" / file);
        EXPECT_TRUE(forgot()) << file;
    }
    write();
    std::ofstream(sample.out / "sample/quick/numbers.json") << "{";
    EXPECT_TRUE(forgot());
}

TEST(ReportFolder, ThePageHasAllSectionsAndNamesWhatIsMissing) {
    const Sample sample;
    const ReportFolder folder(sample.out);
    folder.write(sample.experiment, sample.report(Verdict::not_evaluated), sample.settings, sample.record);
    Experiment other = sample.experiment;
    other.name = "other";
    const std::string page = contents(folder.write_page({sample.experiment, other}));
    const std::string begin = "<script type=\"application/json\" id=\"report\">";
    const std::size_t from = page.find(begin);
    ASSERT_NE(from, std::string::npos);
    const std::string text = page.substr(from + begin.size());
    // Nothing inside of the data ends the element.
    const auto data = nlohmann::json::parse(text.substr(0, text.find("</script>")));
    ASSERT_EQ(data.at("experiments").size(), 1u);
    EXPECT_EQ(data.at("experiments")[0].at("description"), "</script><b>");
    EXPECT_EQ(data.at("experiments")[0].at("command"), sample.record.command);
    EXPECT_EQ(data.at("experiments")[0].at("expectations")[0].at("state"), "not_evaluated");
    ASSERT_EQ(data.at("not_run").size(), 1u);
    EXPECT_EQ(data.at("not_run")[0].at("name"), "other");
    EXPECT_EQ(data.at("papers").size(), 4u);
    for (const char* placeholder : {"@STYLE@", "@SCRIPT@", "@DATA@"})
        EXPECT_EQ(page.find(placeholder), std::string::npos) << placeholder;
}

} // namespace

} // namespace nusselt::lab
