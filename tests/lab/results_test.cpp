#include "lab/results/results.h"

#include "common/results_json.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace nusselt::lab {

namespace {

TEST(Results, SayHowToRepeatThem) {
    const auto json = nlohmann::json::parse(to_json({"rays", {{"isa", "avx2"}, {"width", 3}}, {}}));
    EXPECT_EQ(json.at("bench"), "rays");
    const auto command = json.at("command").get<std::string>();
    EXPECT_EQ(command.find("nusselt_test_lab"), 0u) << command;
    EXPECT_FALSE(json.at("version").get<std::string>().empty());
    EXPECT_GT(json.at("machine").at("threads"), 0);
    EXPECT_TRUE(json.at("machine").at("processor").is_string());
    EXPECT_EQ(json.at("settings"), (nlohmann::json{{"isa", "avx2"}, {"width", 3}}));
    EXPECT_TRUE(json.at("tables").empty());
}

TEST(Results, KeepEachKindOfCell) {
    constexpr auto kLargest = std::numeric_limits<std::uint64_t>::max();
    const Results results = {
        "a",
        {},
        {{"t",
          {{"name"}, {"count"}, {"time", "s"}, {"is_fast"}, {"nothing"}},
          {{"x \"|\" y", kLargest, 0.1, true, nullptr}, {"", -1, std::nan(""), false, INFINITY}}},
         {"none", {{"name"}}}}};
    const std::string text = to_json(results);
    const auto json = nlohmann::json::parse(text);
    EXPECT_EQ(json.at("tables")[0].at("columns")[2], (nlohmann::json{{"name", "time"}, {"unit", "s"}}));
    const auto rows = nusselt_test::records(json, "t");
    EXPECT_EQ(rows[0], (nlohmann::json{{"name", "x \"|\" y"},
                                       {"count", kLargest},
                                       {"time", 0.1},
                                       {"is_fast", true},
                                       {"nothing", nullptr}}));
    EXPECT_EQ(rows[1].at("time"), nullptr);
    EXPECT_EQ(rows[1].at("nothing"), nullptr);
    EXPECT_EQ(rows[1].at("count"), -1);
    EXPECT_TRUE(nusselt_test::records(json, "none").empty());
    // A line for each row, so that changes are easy to read.
    EXPECT_NE(text.find("\n[\"x "), std::string::npos) << text;
}

TEST(Results, RejectRowsWithoutACellForEachColumn) {
    EXPECT_THROW(to_json({"a", {}, {{"t", {{"x"}, {"y"}}, {{1}}}}}), std::logic_error);
}

} // namespace

} // namespace nusselt::lab
