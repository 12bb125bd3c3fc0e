#include "lab/timing/scalar_programs.h"

#include <nlohmann/json.hpp>

#include <stdexcept>

#include "lab/timing/child_process.h"
#include "lab/timing/sampler_timing_lights.h"

namespace nusselt::lab {

namespace {

std::optional<double> number(const nlohmann::json& object, const char* name) {
    const nlohmann::json& value = object.at(name);
    if (value.is_null()) return std::nullopt;
    return value.get<double>();
}

SamplerTiming row_of(const nlohmann::json& row, const std::string& technique, const std::string& costs) {
    SamplerTiming timing;
    timing.technique = technique;
    timing.configuration = row.at("lights").get<std::string>();
    const int vertices = row.at("vertices").get<int>();
    if (vertices > 2) timing.configuration += ", " + std::to_string(vertices) + " vertices";
    const nlohmann::json& ns = row.at(costs + "_ns");
    timing.prepare_ns = number(ns, "prepare");
    timing.sample_ns = number(ns, "sample");
    timing.direction_ns = number(ns, "direction");
    timing.transform_ns = number(ns, "transform");
    timing.world_ns = number(ns, "from_world");
    timing.once_ns = number(ns, "once");
    const nlohmann::json& instructions = row.at(costs + "_instructions");
    timing.prepare_instructions = number(instructions, "prepare");
    timing.sample_instructions = number(instructions, "sample");
    return timing;
}

} // namespace

const std::vector<ScalarProgram>& scalar_programs() {
    // lab/timing/scalar_programs.cmake builds them.
    static const std::vector<ScalarProgram> programs = {
        {"g++ -O2", "scalar-timing-g++-O2"},
        {"g++ -O3 -march=native", "scalar-timing-g++-O3-native"},
        {"clang 19 -O3 -march=native", "scalar-timing-clang19-O3-native"}};
    return programs;
}

std::filesystem::path folder_of_scalar_programs() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "scalar-timing";
}

std::vector<SamplerTiming> scalar_rows_of(const std::string& json, const std::string& code) {
    try {
        const auto document = nlohmann::json::parse(json);
        std::vector<SamplerTiming> rows;
        for (const auto& row : document.at("rows")) {
            const std::string technique = row.at("technique").get<std::string>();
            rows.push_back(row_of(row, technique, "ours"));
            rows.push_back(row_of(row, competitor_of(technique), "published"));
        }
        for (SamplerTiming& row : rows) {
            row.code = code;
            row.isa = document.at("isa").get<std::string>();
        }
        return rows;
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error("the timing program for " + code +
                                 " prints another format: " + error.what());
    }
}

std::vector<SamplerTiming> time_scalar_program(const std::filesystem::path& program, const std::string& code,
                                               int repetitions) {
    const ChildResult child = run_child({program.string(), "--vertices", "all", "--instructions",
                                         "--repetitions", std::to_string(repetitions), "--json", "-"});
    return scalar_rows_of(child.output, code);
}

} // namespace nusselt::lab
