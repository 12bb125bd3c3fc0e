#include "lab/gpu_report/step_results.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace nusselt::lab {

namespace {

std::ifstream open(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error("cannot read '" + file.string() + "'");
    return stream;
}

/// Appends the rows of tables with the same names; the rest comes from the first that has settings.
void append(const Json& more, Json& all) {
    for (const auto& [key, value] : more.items())
        if (key != "tables" && (!all.contains(key) || all.at(key).empty())) all[key] = value;
    for (const Json& table : more.at("tables")) {
        Json& tables = all.at("tables");
        const auto same = std::find_if(tables.begin(), tables.end(),
                                       [&](const Json& one) { return one.at("name") == table.at("name"); });
        if (same == tables.end())
            tables.push_back(table);
        else
            same->at("rows").insert(same->at("rows").end(), table.at("rows").begin(), table.at("rows").end());
    }
}

std::optional<Json> read_json(const std::filesystem::path& file) {
    std::ifstream stream(file);
    Json json = Json::parse(stream, nullptr, false);
    if (json.is_discarded() || !json.is_object() || !json.contains("settings") || !json.contains("tables"))
        return std::nullopt;
    return json;
}

/// The results of a step: of one process, or of one for each scene in a folder with the name of the step.
std::optional<Json> read_results(const std::filesystem::path& folder, const std::string& step) {
    if (!std::filesystem::is_directory(folder / step)) return read_json(folder / (step + ".json"));
    std::set<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder / step)) files.insert(entry.path());
    std::optional<Json> all;
    for (const std::filesystem::path& file : files) {
        std::optional<Json> one = read_json(file);
        if (!one) continue;
        if (all)
            append(*one, *all);
        else
            all = std::move(one);
    }
    return all;
}

} // namespace

std::optional<bool> GpuSteps::supports(const std::string& feature) const {
    const auto device = results.find("device");
    if (device == results.end() || !device->second.at("settings").contains(feature)) return std::nullopt;
    return device->second.at("settings").at(feature).get<bool>();
}

const GpuStep* GpuSteps::find(const std::string& name) const {
    const auto step =
        std::find_if(steps.begin(), steps.end(), [&](const GpuStep& one) { return one.name == name; });
    return step == steps.end() ? nullptr : &*step;
}

GpuSteps read_steps(const std::filesystem::path& folder) {
    const std::set<std::string> outcomes{"passed", "failed", "late", "stopped", "not-run"};
    const std::filesystem::path list = folder / "steps.txt";
    std::ifstream stream = open(list);
    GpuSteps all;
    for (std::string line; std::getline(stream, line);) {
        GpuStep step;
        if (!(std::istringstream(line) >> step.name >> step.outcome >> step.seconds >> step.log) ||
            outcomes.count(step.outcome) == 0)
            throw std::runtime_error("'" + list.string() + "': wrong line '" + line +
                                     "'; write STEP OUTCOME SECONDS LOG");
        if (auto json = read_results(folder, step.name))
            all.results.emplace(step.name, std::move(*json));
        else if (step.outcome == "passed")
            step.outcome = "failed";
        all.steps.push_back(std::move(step));
    }
    return all;
}

std::vector<std::pair<std::string, std::string>> read_manifest(const std::filesystem::path& file) {
    std::vector<std::pair<std::string, std::string>> lines;
    if (file.empty()) return lines;
    std::ifstream stream = open(file);
    for (std::string line; std::getline(stream, line);) {
        const std::size_t colon = line.find(": ");
        if (colon != std::string::npos) lines.emplace_back(line.substr(0, colon), line.substr(colon + 2));
    }
    return lines;
}

std::vector<Json> rows_of(const GpuSteps& steps, const std::string& step, const std::string& table) {
    std::vector<Json> rows;
    const auto results = steps.results.find(step);
    if (results == steps.results.end()) return rows;
    for (const Json& one : results->second.at("tables")) {
        if (one.at("name") != table) continue;
        for (const Json& cells : one.at("rows")) {
            Json& row = rows.emplace_back(Json::object());
            for (std::size_t i = 0; i < cells.size(); ++i)
                row[one.at("columns").at(i).at("name").get<std::string>()] = cells.at(i);
        }
    }
    return rows;
}

} // namespace nusselt::lab
