#include "lab/fuzzing/worst_case_state.h"

#include "base/atomic_file.h"
#include "scene/input/json_node.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace nusselt::lab {

namespace {

long double number_of(const std::string& text) {
    char* end = nullptr;
    const long double x = std::strtold(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(x))
        throw std::runtime_error("'" + text + "' must be a number");
    return x;
}

/// Needed because nlohmann-json silently converts negative numbers and fractions.
std::uint64_t whole_number_of(const nlohmann::json& json) {
    if (!json.is_number_unsigned()) throw std::runtime_error(json.dump() + " must be a whole number");
    return json.get<std::uint64_t>();
}

} // namespace

std::string hexadecimal(long double x) {
    char text[64];
    std::snprintf(text, sizeof text, "%La", x);
    return text;
}

std::optional<SearchState> load_search_state(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) return {};
    const nlohmann::json json = scene::read_json(path);
    std::string problem;
    try {
        SearchState state;
        state.seed = whole_number_of(json.at("seed"));
        for (const auto& [name, target] : json.at("targets").items()) {
            SearchProgress& progress = state.targets[name];
            progress.starts = whole_number_of(target.at("starts"));
            for (const auto& text : target.at("parameters"))
                progress.parameters.push_back(number_of(text.get<std::string>()));
        }
        return state;
    } catch (const nlohmann::json::exception&) {
        problem = "it lacks a field";
    } catch (const std::exception& error) {
        problem = error.what();
    }
    throw std::runtime_error(
        fmt::format("{}: the file is not the state of a search for worst cases: {}; choose another file",
                    path.string(), problem));
}

void save_search_state(const std::filesystem::path& path, const SearchState& state) {
    auto targets = nlohmann::ordered_json::object();
    for (const auto& [name, progress] : state.targets) {
        auto parameters = nlohmann::ordered_json::array();
        for (const long double x : progress.parameters) parameters.push_back(hexadecimal(x));
        targets[name] = {{"starts", progress.starts}, {"parameters", parameters}};
    }
    const nlohmann::ordered_json json = {{"seed", state.seed}, {"targets", targets}};
    base::write_atomically(path, [&](std::ofstream& file) { file << json.dump(2) << "\n"; });
}

} // namespace nusselt::lab
