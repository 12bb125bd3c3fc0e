#pragma once
/// Reads what commands of the laboratory write with --json.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace nusselt_test {

/// The rows of a table as objects, with a member for each column.
inline nlohmann::json records(const nlohmann::json& results, const std::string& table) {
    for (const nlohmann::json& one : results.at("tables")) {
        if (one.at("name") != table) continue;
        auto list = nlohmann::json::array();
        for (const nlohmann::json& row : one.at("rows")) {
            EXPECT_EQ(row.size(), one.at("columns").size());
            auto object = nlohmann::json::object();
            for (std::size_t i = 0; i < row.size(); ++i)
                object[one.at("columns").at(i).at("name").get<std::string>()] = row.at(i);
            list.push_back(object);
        }
        return list;
    }
    ADD_FAILURE() << "no table " << table;
    return nlohmann::json::array();
}

} // namespace nusselt_test
