#include "gather.h"

#include "apps/common/help.h"
#include "apps/common/print_message.h"
#include "base/file_checks.h"
#include "base/json_output.h"
#include "lab/results/results.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>

namespace nusselt::app {

namespace {

using Json = nlohmann::ordered_json;

/// \throws std::runtime_error naming the file
Json read_results(const std::filesystem::path& path) {
    std::ifstream stream(path);
    Json json = Json::parse(stream, nullptr, false);
    if (json.is_discarded() || !json.contains("bench") || !json.contains("version") ||
        !json.contains("tables"))
        throw std::runtime_error(fmt::format(
            "'{}' has no results of nusselt-lab, or only some of them; delete it and do this shard again",
            path.string()));
    return json;
}

lab::Cell cell_of(const Json& json) {
    if (json.is_boolean()) return json.get<bool>();
    if (json.is_number_unsigned()) return json.get<std::uint64_t>();
    if (json.is_number_integer()) return json.get<std::int64_t>();
    if (json.is_number()) return json.get<double>();
    if (json.is_string()) return json.get<std::string>();
    return nullptr;
}

/// The number in a column of this name, if a row has one.
std::optional<double> number_of(const Json& table, const Json& row, const std::string& name) {
    for (std::size_t i = 0; i < row.size(); ++i)
        if (table.at("columns").at(i).at("name") == name && row[i].is_number()) return row[i].get<double>();
    return std::nullopt;
}

/// What a shard says of a broken contract or a broken bound.
bool is_broken(const Json& table, const Json& row) {
    if (number_of(table, row, "violations").value_or(0) > 0) return true;
    const auto error = number_of(table, row, "error");
    const auto bound = number_of(table, row, "bound");
    return error && bound && *error > *bound;
}

/// Adds the rows of a shard. \throws std::runtime_error if its table is another one
void append(const Json& table, std::uint64_t shard, const std::filesystem::path& path,
            lab::ResultTable& result) {
    for (const Json& row : table.at("rows")) {
        if (row.size() + 1 != result.columns.size())
            throw std::runtime_error(fmt::format(
                "'{}' has other columns than the first shard; do this shard again", path.string()));
        std::vector<lab::Cell> cells = {shard};
        for (const Json& cell : row) cells.push_back(cell_of(cell));
        result.rows.push_back(std::move(cells));
    }
}

} // namespace

int run_gather(const GatherOptions& options) {
    base::check_exist(options.shards);
    lab::Results results;
    bool has_broken = false;
    Json first;
    for (std::size_t i = 0; i < options.shards.size(); ++i) {
        const std::filesystem::path& path = options.shards[i];
        const Json json = read_results(path);
        if (i == 0) {
            first = json;
            results.bench = json.at("bench").get<std::string>();
            results.settings = {{"shards", std::uint64_t(options.shards.size())}};
            for (const Json& table : json.at("tables")) {
                lab::ResultTable empty = {table.at("name").get<std::string>(), {{"shard"}}};
                for (const Json& column : table.at("columns"))
                    empty.columns.push_back({column.at("name").get<std::string>(), column.value("unit", "")});
                results.tables.push_back(std::move(empty));
            }
        }
        for (const char* key : {"bench", "version"})
            if (json.at(key) != first.at(key))
                throw std::runtime_error(
                    fmt::format("'{}' belongs to another job: its {} is {}, but that of the first "
                                "shard is {}",
                                path.string(), key, json.at(key).dump(), first.at(key).dump()));
        if (json.at("tables").size() != results.tables.size())
            throw std::runtime_error(fmt::format(
                "'{}' has other tables than the first shard; do this shard again", path.string()));
        for (std::size_t t = 0; t < results.tables.size(); ++t) {
            const Json& table = json.at("tables").at(t);
            append(table, i + 1, path, results.tables[t]);
            for (const Json& row : table.at("rows")) has_broken |= is_broken(table, row);
        }
    }
    base::write_json(options.output, lab::to_json(results));
    if (has_broken)
        print_message("nusselt-lab: error: a shard found a broken contract; see '{}'\n", options.output);
    return has_broken ? 1 : 0;
}

void setup_gather(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<GatherOptions>();
    CLI::App* command = app.add_subcommand(
        "gather", "Put the results of shards (`nusselt-lab submit fuzz` and its like) into one file, with a "
                  "column for the "
                  "shard. Exits with 1 if a shard found a violation, or an error above its bound.");
    command->add_option("-o,--output", options->output, "JSON file to write, or - for the standard output")
        ->type_name("FILE")
        ->required()
        ->group(kOutputGroup);
    command->add_option("SHARDS", options->shards, "Files of --json, one or more")->required();
    command->callback([options, &exit_code] { exit_code = run_gather(*options); });
}

} // namespace nusselt::app
