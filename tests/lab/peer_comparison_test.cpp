#include "lab/peers/peer_comparison.h"

#include "common/source_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace nusselt::lab {

namespace {

/// What compare.py measured for the documentation.
std::string measured() {
    std::ifstream file(std::filesystem::path(nusselt_test::kSourceFolder) / "docs/data/peers.json");
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The text with another value of a column in the row of a scene.
std::string with(std::string text, const std::string& table, const std::string& column,
                 const std::string& scene, const std::string& value) {
    const std::size_t head = text.find("\"name\": \"" + table + "\"");
    std::size_t names = text.find("\"columns\"", head);
    const std::size_t end_of_names = text.find("\"" + column + "\"", names);
    std::size_t index = 0;
    for (; (names = text.find("\"name\"", names + 1)) < end_of_names;) ++index;
    --index; // the last name is that of the column
    std::size_t begin = text.find("[\"" + scene + "\"", head) + 1;
    for (; index > 0; --index) begin = text.find(',', begin) + 1;
    return text.replace(begin, text.find_first_of(",]", begin) - begin, value);
}

Verdict verdict(const PeerComparison& comparison, const std::string& json) {
    return verdict_of(report_of(peer_comparison_of(comparison, json)).expectations);
}

TEST(PeerComparison, TheNumbersOfTheDocumentationMeetAllExpectations) {
    for (const PeerComparison& comparison : all_peer_comparisons()) {
        const Report report = report_of(peer_comparison_of(comparison, measured()));
        EXPECT_EQ(verdict_of(report.expectations), Verdict::holds) << to_text(report);
        EXPECT_EQ(report.tables.at(0).size(), 4u);
        EXPECT_EQ(report.tables[0][3].back(), "1"); // Cycles over Cycles
        const bool has_aim = comparison.scene.find("panel") == 0 || comparison.scene == "tube";
        EXPECT_EQ(report.expectations.size(), has_aim ? 2u : 1u) << comparison.name;
    }
}

TEST(PeerComparison, MissedAimsAndOtherImagesFail) {
    const PeerComparison tube = all_peer_comparisons().at(2);
    ASSERT_EQ(tube.scene, "tube");
    const std::string json = measured();
    EXPECT_EQ(verdict(tube, with(json, "ratios", "efficiency_ratio", "tube", " 300")), Verdict::holds);
    EXPECT_EQ(verdict(tube, with(json, "ratios", "efficiency_ratio", "tube", " 299.9")), Verdict::fails);
    EXPECT_EQ(verdict(tube, with(json, "ratios", "target", "tube", " null")), Verdict::holds);
    EXPECT_EQ(verdict(tube, with(json, "references", "mean_ratio", "tube", " 1.0099")), Verdict::holds);
    EXPECT_EQ(verdict(tube, with(json, "references", "mean_ratio", "tube", " 0.9899")), Verdict::fails);
    // Those of other scenes do not count.
    EXPECT_EQ(verdict(tube, with(json, "ratios", "efficiency_ratio", "panel", " 1")), Verdict::holds);
}

TEST(PeerComparison, MissingNumbersAreErrors) {
    const PeerComparison tube = all_peer_comparisons().at(2);
    const std::string json = measured();
    for (const std::string& damaged :
         {std::string("{"), std::string("{}"), std::string("[]"), json.substr(0, json.size() / 2)})
        EXPECT_THROW(peer_comparison_of(tube, damaged), std::runtime_error);
    EXPECT_THROW(verdict(tube, with(json, "ratios", "efficiency_ratio", "tube", " null")),
                 std::runtime_error);
    PeerComparison other = tube;
    other.scene = "no such scene";
    EXPECT_THROW(verdict(other, json), std::runtime_error);
}

TEST(PeerComparison, QuickOnesRenderLess) {
    const PeerComparison full = all_peer_comparisons().at(0), less = quick(full);
    EXPECT_LT(less.repetitions, full.repetitions);
    EXPECT_LT(less.reference_samples, full.reference_samples);
    EXPECT_GT(less.shrink, full.shrink);
}

} // namespace

} // namespace nusselt::lab
