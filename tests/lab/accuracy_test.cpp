#include "common/source_folder.h"
#include "lab/accuracy/accuracy_json.h"
#include "lab/accuracy/accuracy_page.h"
#include "lab/accuracy/accuracy_targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace nusselt::lab {

using proof::AccuracyRow;

namespace {

const std::filesystem::path kDocs = std::filesystem::path(nusselt_test::kSourceFolder) / "docs";

const AccuracyTable& baseline() {
    static const AccuracyTable table = read_accuracy_json(kDocs / "accuracy.json");
    return table;
}

AccuracyRow& row(AccuracyTable& table, const std::string& technique, const std::string& lights,
                 const std::string& method) {
    const auto found = std::find_if(table.rows.begin(), table.rows.end(), [&](const AccuracyRow& r) {
        return r.technique == technique && r.scalar == "float" && r.lights == lights && r.method == method;
    });
    if (found == table.rows.end()) throw std::runtime_error("no row " + technique + ", " + lights);
    return *found;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

constexpr const char* kUpdate =
    "\nAfter an intended change, see docs/testing.md on how to update the tables.";

TEST(Accuracy, IsNotWorseThanTheCommittedTables) {
    const AccuracyTable measured = measure_accuracy({baseline().count, {}});
    const std::vector<std::string> complaints = compare_with_baseline(baseline(), measured);
    EXPECT_TRUE(complaints.empty()) << joined(complaints) << kUpdate;
}

TEST(Accuracy, PageShowsTheCommittedTables) {
    std::ifstream file(kDocs / "accuracy.md");
    const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    EXPECT_TRUE(page == accuracy_page(baseline()))
        << "docs/accuracy.md does not follow from accuracy.json" << kUpdate;
}

TEST(Accuracy, EveryTechniqueHasScalarRowsAndPacks) {
    AccuracyTable table = baseline();
    for (const char* technique :
         {"PolygonArea", "PolygonSolidAngle", "PolygonClippedSolidAngle", "PolygonProjectedSolidAngle",
          "PolygonProjectedSolidAngleBiased", "LineArea", "LineSolidAngle", "LineClippedSolidAngle",
          "LineProjectedSolidAngle"})
        for (const char* method : {"ours", "ours, packs"})
            EXPECT_GT(row(table, technique, "crossing the horizon", method).backward.median, 0) << technique;
}

// The comparison itself.

TEST(AccuracyBaseline, AcceptsItself) {
    EXPECT_EQ(joined(compare_with_baseline(baseline(), baseline())), "");
}

TEST(AccuracyBaseline, AcceptsBetterRows) {
    AccuracyTable better = baseline();
    for (AccuracyRow& r : better.rows) r.backward.p99 = r.measure.max = 0;
    EXPECT_EQ(joined(compare_with_baseline(baseline(), better)), "");
}

TEST(AccuracyBaseline, RejectsEachWorseQuantity) {
    const auto complaint_after = [](auto change) {
        AccuracyTable worse = baseline();
        change(row(worse, "PolygonProjectedSolidAngle", "decentral", "ours"));
        const std::vector<std::string> complaints = compare_with_baseline(baseline(), worse);
        EXPECT_EQ(complaints.size(), 1u) << joined(complaints);
        return joined(complaints);
    };
    EXPECT_NE(complaint_after([](AccuracyRow& r) { r.backward.median *= 2; }).find("backward error, median"),
              std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { r.backward.p99 *= 2; }).find("backward error, 99 %"),
              std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { r.backward.p999 *= 2; }).find("backward error, 99.9 %"),
              std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { r.backward.max *= 2; }).find("backward error, largest"),
              std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { r.measure.p99 *= 2; }).find("error of the measure, 99 %"),
              std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { ++r.off_the_light; }).find("off the light"),
              std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { ++r.no_sample; }).find("without a sample"),
              std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { ++r.spurious; }).find("spurious"), std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { ++r.nan; }).find("NaN"), std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { ++r.infinite; }).find("infinite"), std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { ++r.negative; }).find("negative"), std::string::npos);
    EXPECT_NE(complaint_after([](AccuracyRow& r) { --r.count; }).find("other lights"), std::string::npos);
}

TEST(AccuracyBaseline, RejectsMissingAndUnknownRowsOfOurs) {
    AccuracyTable fewer = baseline();
    fewer.rows.erase(std::find_if(fewer.rows.begin(), fewer.rows.end(),
                                  [](const AccuracyRow& r) { return r.method == "ours, packs"; }));
    const auto missing = compare_with_baseline(baseline(), fewer);
    ASSERT_EQ(missing.size(), 1u) << joined(missing);
    EXPECT_NE(missing[0].find("was not measured"), std::string::npos) << missing[0];
    const auto unknown = compare_with_baseline(fewer, baseline());
    ASSERT_EQ(unknown.size(), 1u) << joined(unknown);
    EXPECT_NE(unknown[0].find("is not in the baseline"), std::string::npos) << unknown[0];
}

TEST(AccuracyBaseline, NamesAFileThatIsNone) {
    for (const char* name : {"accuracy.md", "no-such-file.json"}) {
        try {
            read_accuracy_json(kDocs / name);
            FAIL() << "no exception for " << name;
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    }
}

// The targets.

const AccuracyVerdict& verdict(const std::vector<AccuracyVerdict>& verdicts, const std::string& technique,
                               const std::string& lights, AccuracyQuantity quantity) {
    return *std::find_if(verdicts.begin(), verdicts.end(), [&](const AccuracyVerdict& v) {
        return v.target.technique == technique && v.target.lights == lights && v.target.quantity == quantity;
    });
}

TEST(AccuracyTargets, TakeTheWorseOfScalarCodeAndPacks) {
    AccuracyTable table = baseline();
    const char* kTechnique = "PolygonProjectedSolidAngle";
    row(table, kTechnique, "decentral", "floor").backward.p99 = 1e-7;
    row(table, kTechnique, "decentral", "ours").backward.p99 = 9e-7;
    for (const double packs : {9.9e-7, 10.1e-7}) {
        row(table, kTechnique, "decentral", "ours, packs").backward.p99 = packs;
        const auto verdicts = check_targets(table.rows);
        const AccuracyVerdict& v =
            verdict(verdicts, kTechnique, "decentral", AccuracyQuantity::p99_over_floor);
        EXPECT_NEAR(v.value, packs / 1e-7, 1e-6);
        EXPECT_EQ(v.met, packs < 1e-6);
    }
}

TEST(AccuracyTargets, NameTheWorstClass) {
    AccuracyTable table = baseline();
    row(table, "LineProjectedSolidAngle", "1 cm at 40 m", "ours").nan = 3;
    const auto verdicts = check_targets(table.rows);
    const AccuracyVerdict& v =
        verdict(verdicts, "LineProjectedSolidAngle", kEveryClass, AccuracyQuantity::invalid);
    EXPECT_EQ(v.value, 3);
    EXPECT_EQ(v.lights, "1 cm at 40 m");
    EXPECT_FALSE(v.met);
}

TEST(AccuracyTargets, AreMissedWithoutRows) {
    for (const AccuracyVerdict& v : check_targets({})) EXPECT_FALSE(v.met) << v.target.lights;
}

// The instrument: the published formulas fail where their paper says so.
TEST(Accuracy, PlainFormulasLoseSmallLights) {
    AccuracyTable table = baseline();
    const AccuracyRow& small = row(table, "PolygonProjectedSolidAngle", "square of 1 mm at 40 m", "plain");
    EXPECT_GT(small.backward.p99, 0.5);
    EXPECT_GT(small.off_the_light, small.count / 10);
    EXPECT_GT(row(table, "LineProjectedSolidAngle", "pointing at the point within 1e-4", "plain").nan, 0);
    EXPECT_LT(row(table, "PolygonProjectedSolidAngle", "central", "plain").backward.p99, 1e-6);
}

} // namespace

} // namespace nusselt::lab
