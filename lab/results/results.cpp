#include "lab/results/results.h"

#include "base/machine.h"

#include <nlohmann/json.hpp>

#include <stdexcept>
#include <thread>

namespace nusselt::lab {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Cell& cell) {
    return std::visit([](const auto& value) { return Json(value); }, cell);
}

/// In one line. Paths may hold bytes that are not UTF-8.
std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string text_of(const ResultTable& table) {
    Json columns = Json::array();
    for (const Column& column : table.columns) {
        columns.push_back({{"name", column.name}});
        if (!column.unit.empty()) columns.back()["unit"] = column.unit;
    }
    std::string text = "{\"name\": " + line_of(table.name) + ", \"columns\": " + line_of(columns);
    const char* separator = ", \"rows\": [\n";
    for (const std::vector<Cell>& row : table.rows) {
        if (row.size() != table.columns.size())
            throw std::logic_error("table " + table.name + ": a row without a cell for each column");
        Json cells = Json::array();
        for (const Cell& cell : row) cells.push_back(json_of(cell));
        text += separator + line_of(cells);
        separator = ",\n";
    }
    return text + (table.rows.empty() ? ", \"rows\": []}" : "\n]}");
}

} // namespace

std::string to_json(const Results& results) {
    Json settings = Json::object();
    for (const auto& [name, value] : results.settings) settings[name] = json_of(value);
    const Json machine = {{"processor", base::processor_name()},
                          {"threads", std::thread::hardware_concurrency()}};
    std::string text = "{\"bench\": " + line_of(results.bench) +
                       ",\n\"command\": " + line_of(base::command_line()) +
                       ",\n\"version\": " + line_of(NUSSELT_VERSION) + ",\n\"machine\": " + line_of(machine) +
                       ",\n\"settings\": " + line_of(settings) + ",\n\"tables\": [";
    const char* separator = "\n";
    for (const ResultTable& table : results.tables) {
        text += separator + text_of(table);
        separator = ",\n";
    }
    return text + "\n]}\n";
}

} // namespace nusselt::lab
