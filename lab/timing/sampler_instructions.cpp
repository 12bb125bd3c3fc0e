#include "lab/timing/sampler_instructions.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>

#include "lab/timing/sampler_loops.h"
#include "lab/timing/sampler_timing.h"
#include "lab/timing/sampler_timing_lights.h"
#include "lab/timing/scalar/instructions.h"

namespace nusselt::lab {

namespace {

using Json = nlohmann::json;

/// Few, because each instruction stops the processor, which takes ten microseconds.
constexpr int kCountedLights = 4;
constexpr int kCountedPacks = 1;

/// Differences below this are those of the calls around the technique [instructions].
constexpr double kFew = 4;

constexpr const char* kTable = "instructions";

/// What count_instructions() runs: it takes a plain function.
SamplerLoops* counted = nullptr;
void (*counted_samples)(const void*, const void*, int) = nullptr;

struct Count {
    double prepare, sample;
};

/// Per group of lights, with the calls.
std::optional<Count> count(const TimedTechnique& technique, LoadedLights& lights) {
    const int groups = technique.lanes == 1 ? kCountedLights : kCountedPacks;
    SamplerLoops loops(technique, lights, groups);
    counted = &loops;
    counted_samples = technique.sample;
    const auto prepare =
        count_instructions([](int first, int end) { counted->prepare(first, end); }, 0, groups);
    loops.keep(groups);
    const auto sample =
        count_instructions([](int, int end) { counted->draw(counted_samples, end, 1); }, 0, groups);
    if (!prepare || !sample) return std::nullopt;
    return Count{static_cast<double>(*prepare) / groups, static_cast<double>(*sample) / groups};
}

bool is_counted(const TimedConfiguration& c) {
    if (is_polygon(c.kind)) return c.vertex_count == 4 && std::string(c.lights.name) != kCentral.name;
    return true;
}

std::string name_of_compiler() {
#if defined(__clang__)
    return fmt::format("clang {}", __clang_major__);
#else
    return fmt::format("g++ {}", __GNUC__);
#endif
}

bool same_row(const SamplerInstructions& a, const SamplerInstructions& b) {
    return a.technique == b.technique && a.configuration == b.configuration && a.code == b.code;
}

std::string name_of(const SamplerInstructions& row) {
    return fmt::format("{}, {}, {}", row.technique, row.configuration, row.code);
}

const SamplerInstructions* find(const SamplerInstructionTable& table, const SamplerInstructions& row) {
    const auto found = std::find_if(table.rows.begin(), table.rows.end(),
                                    [&](const SamplerInstructions& other) { return same_row(row, other); });
    return found == table.rows.end() ? nullptr : &*found;
}

} // namespace

SamplerInstructionTable count_sampler_instructions(base::Isa isa,
                                                   const std::vector<TimedTechnique>& techniques) {
    SamplerInstructionTable table{std::string(base::name_of(isa)), name_of_compiler(), {}};
    const auto lights = std::make_unique<TimedLights>();
    for (const TimedConfiguration& c : timed_configurations()) {
        if (!is_counted(c)) continue;
        make_timed_lights(c, 1, *lights);
        std::map<int, Count> baseline; // by number of lanes
        for (const TimedTechnique& t : techniques) {
            if (t.kind != c.kind || t.vertex_count != c.vertex_count) continue;
            LoadedLights loaded(*lights, *t.light_type, t.lanes);
            const std::optional<Count> now = count(t, loaded);
            if (!now) return {table.isa, table.compiler, {}};
            // The baseline precedes the techniques.
            const Count without = baseline.emplace(t.lanes, *now).first->second;
            if (t.name == std::string("Baseline")) continue;
            table.rows.push_back({t.name, c.name, name_of_code(t.lanes), now->prepare - without.prepare,
                                  now->sample - without.sample});
        }
    }
    return table;
}

SamplerInstructionTable read_sampler_instructions(const std::filesystem::path& json) {
    std::ifstream file(json);
    if (!file) throw std::runtime_error(json.string() + ": cannot read the file");
    try {
        const Json document = Json::parse(file);
        const Json& settings = document.at("settings");
        SamplerInstructionTable table{
            settings.at("isa").get<std::string>(), settings.at("compiler").get<std::string>(), {}};
        const Json& rows = document.at("tables").at(0);
        if (rows.at("name") != kTable) throw std::runtime_error(json.string() + ": has another table");
        for (const Json& row : rows.at("rows"))
            table.rows.push_back({row.at(0).get<std::string>(), row.at(1).get<std::string>(),
                                  row.at(2).get<std::string>(), row.at(3).get<double>(),
                                  row.at(4).get<double>()});
        return table;
    } catch (const Json::exception& error) {
        throw std::runtime_error(json.string() + ": the file has no instruction counts: " + error.what());
    }
}

Results results_of(const SamplerInstructionTable& table) {
    ResultTable rows = {
        kTable,
        {{"technique"}, {"lights"}, {"code"}, {"prepare", "instructions"}, {"sample", "instructions"}}};
    for (const SamplerInstructions& row : table.rows)
        rows.rows.push_back({row.technique, row.configuration, row.code, row.prepare, row.sample});
    return {"instructions", {{"isa", table.isa}, {"compiler", table.compiler}}, {std::move(rows)}};
}

std::vector<std::string> moved_costs(const SamplerInstructionTable& before,
                                     const SamplerInstructionTable& now, double tolerance) {
    std::vector<std::string> moved;
    for (const SamplerInstructions& row : before.rows)
        if (find(now, row) == nullptr) moved.push_back(name_of(row) + ": is no longer counted");
    for (const SamplerInstructions& row : now.rows) {
        const SamplerInstructions* const old = find(before, row);
        if (old == nullptr) {
            moved.push_back(name_of(row) + ": is new");
            continue;
        }
        const auto compare = [&](const char* what, double count, double was) {
            if (std::fabs(count - was) > kFew + tolerance * std::fabs(was))
                moved.push_back(fmt::format("{}: {} takes {:.0f} instructions, not {:.0f}", name_of(row),
                                            what, count, was));
        };
        compare("preparing", row.prepare, old->prepare);
        compare("a sample", row.sample, old->sample);
    }
    return moved;
}

} // namespace nusselt::lab
