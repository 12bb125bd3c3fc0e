#include "gather.h"

#include "apps/common/help.h"
#include "apps/common/path_list.h"
#include "apps/common/print_message.h"
#include "base/file_checks.h"
#include "base/json_output.h"
#include "lab/results/results.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace nusselt::app {

namespace {

using Json = nlohmann::ordered_json;

/// Settings that differ between the shards of one job.
const std::set<std::string> kSettingsOfShards = {"seed", "first", "count", "starts", "seconds", "threads"};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& problem) {
    throw std::runtime_error(fmt::format("'{}' {}", path.string(), problem));
}

/// \throws std::runtime_error naming the file
Json read_results(const std::filesystem::path& path) {
    if (std::filesystem::is_directory(path))
        throw std::runtime_error(fmt::format("'{}' is a folder; name files of shards", path.string()));
    std::ifstream stream(path);
    Json json = Json::parse(stream, nullptr, false);
    const auto is_table = [](const Json& table) {
        return table.is_object() && table.contains("name") && table.contains("columns") &&
               table.contains("rows") && table["name"].is_string() && table["columns"].is_array() &&
               table["rows"].is_array();
    };
    if (!json.is_object() || !json.contains("bench") || !json["bench"].is_string() ||
        !json.contains("version") || !json.contains("settings") || !json["settings"].is_object() ||
        !json.contains("tables") || !json["tables"].is_array() ||
        !std::all_of(json["tables"].begin(), json["tables"].end(), is_table))
        refuse(path,
               "has no results of nusselt-lab, or only some of them; delete it and do this shard again");
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
        if (!row.is_array() || row.size() + 1 != result.columns.size())
            refuse(path, "has a row without a cell for each column; do this shard again");
        std::vector<lab::Cell> cells = {shard};
        for (const Json& cell : row) cells.push_back(cell_of(cell));
        result.rows.push_back(std::move(cells));
    }
}

/// The columns of all tables, and the settings that shards share.
Json common_part(const Json& json) {
    Json common = {{"bench", json.at("bench")}, {"version", json.at("version")}};
    for (const auto& [name, value] : json.at("settings").items())
        if (kSettingsOfShards.count(name) == 0) common["setting " + name] = value;
    for (const Json& table : json.at("tables"))
        common["table " + table.at("name").get<std::string>()] = table.at("columns");
    return common;
}

void check_same(const Json& first, const Json& other, const std::filesystem::path& path) {
    const Json a = common_part(first), b = common_part(other);
    for (const auto& [name, value] : a.items())
        if (!b.contains(name) || b[name] != value)
            refuse(path,
                   fmt::format("belongs to another job: its {} is {}, but that of the first shard is {}",
                               name, b.contains(name) ? b[name].dump() : "missing", value.dump()));
    if (a.size() != b.size() || first.at("tables").size() != other.at("tables").size())
        refuse(path, "has other tables or settings than the first shard; do this shard again");
}

/// Shards must be different pieces of one run: of different seeds, or one after the other without a gap.
class Pieces {
public:
    void add(const Json& settings, const std::filesystem::path& path) {
        const auto number = [&](const char* name) {
            return settings.contains(name) && settings[name].is_number_unsigned()
                       ? settings[name].get<std::uint64_t>()
                       : 0;
        };
        const auto [other, is_new] =
            pieces_.insert({{number("seed"), number("first")}, {number("count"), path}});
        if (!is_new)
            refuse(path,
                   fmt::format("has the same seed and the same first case as '{}', and would count twice",
                               other->second.second.string()));
        has_counts_ |= settings.contains("first") && settings.contains("count");
    }
    void check() const {
        if (!has_counts_) return;
        for (auto piece = pieces_.begin(), next = std::next(piece); next != pieces_.end(); piece = next++) {
            const auto& [seed, first] = piece->first;
            if (next->first != std::pair(seed, first + piece->second.first))
                refuse(
                    next->second.second,
                    fmt::format("does not begin where '{}' ends; give all shards of one job, and no others",
                                piece->second.second.string()));
        }
    }

private:
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::pair<std::uint64_t, std::filesystem::path>>
        pieces_;
    bool has_counts_ = false;
};

/// What all shards have in common, and no rows.
lab::Results empty_results(const Json& first, std::size_t shards) {
    lab::Results results;
    results.bench = first.at("bench").get<std::string>();
    for (const auto& [name, value] : first.at("settings").items())
        if (kSettingsOfShards.count(name) == 0) results.settings.emplace_back(name, cell_of(value));
    results.settings.emplace_back("shards", std::uint64_t(shards));
    for (const Json& table : first.at("tables")) {
        lab::ResultTable empty = {table.at("name").get<std::string>(), {{"shard"}}};
        for (const Json& column : table.at("columns"))
            empty.columns.push_back({column.at("name").get<std::string>(), column.value("unit", "")});
        results.tables.push_back(std::move(empty));
    }
    return results;
}

} // namespace

int run_gather(const GatherOptions& options) {
    const std::vector<std::filesystem::path> shards = with_listed(options.shards, options.list);
    base::check_exist(shards);
    lab::Results results;
    Pieces pieces;
    bool has_broken = false;
    Json first;
    for (std::size_t i = 0; i < shards.size(); ++i) {
        const std::filesystem::path& path = shards[i];
        const Json json = read_results(path);
        try {
            if (i == 0) {
                first = json;
                results = empty_results(json, shards.size());
            }
            check_same(first, json, path);
            pieces.add(json.at("settings"), path);
            for (std::size_t t = 0; t < results.tables.size(); ++t) {
                const Json& table = json.at("tables").at(t);
                append(table, i + 1, path, results.tables[t]);
                for (const Json& row : table.at("rows")) has_broken |= is_broken(table, row);
            }
        } catch (const Json::exception& error) {
            refuse(path,
                   fmt::format("has no results of nusselt-lab ({}); do this shard again", error.what()));
        }
    }
    pieces.check();
    base::write_json(options.output, lab::to_json(results));
    if (has_broken)
        print_message("nusselt-lab: error: a shard found a broken contract; see '{}'\n", options.output);
    return has_broken ? 1 : 0;
}

void setup_gather(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<GatherOptions>();
    CLI::App* command = app.add_subcommand(
        "gather",
        "Put the results of shards (`nusselt-lab submit fuzz` and its like) into one file, with a column for "
        "the shard. Exits with 1 if a shard found a violation, or an error above its bound.");
    command->add_option("-o,--output", options->output, "JSON file to write, or - for the standard output")
        ->type_name("FILE")
        ->required()
        ->group(kOutputGroup);
    command->add_option("SHARDS", options->shards, "Files of --json, one or more; not required with --list");
    add_list_option(*command, options->list, "shards");
    command->callback([options, &exit_code] {
        if (options->shards.empty() && !options->list) throw CLI::RequiredError("SHARDS");
        exit_code = run_gather(*options);
    });
}

} // namespace nusselt::app
