#pragma once
/// The names of published numbers.

#include "common/source_folder.h"
#include "lab/report/report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>

namespace nusselt::lab {

/// The page shows a number beside the published one if the list of the papers has both names.
inline void expect_names_of_published_numbers(const Report& report) {
    std::ifstream file(std::filesystem::path(nusselt_test::kSourceFolder) / "lab/report/published.json");
    const auto published = nlohmann::json::parse(file);
    std::set<std::pair<std::string, std::string>> names;
    for (const auto& paper : published.at("papers"))
        for (const auto& item : paper.at("items"))
            for (const auto& number : item.at("published"))
                names.emplace(item.at("id"), number.at("quantity"));
    for (const Measured& m : report.measured)
        EXPECT_EQ(names.count({m.item, m.quantity}), 1u) << m.item << ": " << m.quantity;
}

} // namespace nusselt::lab
