#include "lab/gpu_report/gpu_report.h"

#include "lab/gpu_report/report_tables.h"
#include "lab/gpu_report/step_results.h"

#include <fmt/core.h>

#include <stdexcept>

namespace nusselt::lab {

namespace {

/// What a row of the first table is about. Some parts of steps need a feature that a device may lack.
struct Part {
    const char* step;
    const char* name;
    const char* feature = nullptr; ///< in the settings of the step `device`
    const char* lack = nullptr;    ///< why the part does not apply without it
};

constexpr const char* kTwoRoundings = "the device rounds fma twice, which these shaders must not be used on";
constexpr const char* kNoQueries = "the driver has no ray queries";
constexpr Part kParts[] = {
    {"device", "the device and what it supports"},
    {"parity", "errors of GLSL compared with C++, shaders for any device"},
    {"parity", "errors of GLSL compared with C++, shaders for a fused fma", "fused_fma", kTwoRoundings},
    {"agreement", "images compared with those of the CPU, rays by shaders"},
    {"agreement", "images compared with those of the CPU, ray queries", "ray_queries", kNoQueries},
    {"samplers", "cost of samples"},
    {"frames", "cost of frames, rays by shaders"},
    {"frames", "cost of frames, ray queries", "ray_queries", kNoQueries},
};

struct PartResult {
    std::string name, outcome, remark;
    bool passes;
};

std::string remark_on(const GpuStep& step) {
    if (step.outcome == "passed") return fmt::format("{} s", step.seconds);
    if (step.outcome == "late") return fmt::format("no end after {} s, see {}", step.seconds, step.log);
    if (step.outcome == "stopped") return fmt::format("stopped after {} s, see {}", step.seconds, step.log);
    if (step.outcome == "not-run") return "an earlier step ended the run";
    return fmt::format("after {} s, see {}", step.seconds, step.log);
}

PartResult result_of(const Part& part, const GpuSteps& steps) {
    const GpuStep* step = steps.find(part.step);
    if (step == nullptr) return {part.name, "not run", "it is missing in steps.txt", false};
    if (part.feature != nullptr && steps.supports(part.feature) == false)
        return {part.name, "not applicable", part.lack, true};
    const bool passes = step->outcome == "passed";
    std::string outcome = step->outcome == "not-run" ? "not run"
                          : step->outcome == "late"  ? "failed"
                                                     : step->outcome;
    if (!passes && outcome == "failed") outcome = "**failed**";
    return {part.name, outcome, remark_on(*step), passes};
}

std::vector<PartResult> results_of_parts(const GpuSteps& steps) {
    std::vector<PartResult> results;
    for (const Part& part : kParts) results.push_back(result_of(part, steps));
    return results;
}

/// A setting that the step `device` found, as text.
std::string of_device(const GpuSteps& steps, const char* key) {
    const auto device = steps.results.find("device");
    if (device == steps.results.end() || !device->second.at("settings").contains(key)) return "unknown";
    const Json& value = device->second.at("settings").at(key);
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    return value.get<std::string>();
}

std::string head_of(const GpuSteps& steps, const std::vector<std::pair<std::string, std::string>>& manifest) {
    std::string text = fmt::format("# {}\n\n", of_device(steps, "device"));
    text += fmt::format("{}, driver {}, Vulkan {}; ray queries: {}; fused fma: {}; clock: {}.\n",
                        of_device(steps, "kind"), of_device(steps, "driver"), of_device(steps, "vulkan"),
                        of_device(steps, "ray_queries"), of_device(steps, "fused_fma"),
                        of_device(steps, "clock"));
    if (const auto device = steps.results.find("device"); device != steps.results.end()) {
        const Json& machine = device->second.at("machine");
        text += fmt::format("Processor: {}, {} threads.\n", machine.at("processor").get<std::string>(),
                            machine.at("threads").get<int>());
    }
    for (const auto& [key, value] : manifest)
        if (key == "version" || key == "commit") text += fmt::format("Nusselt's {}: {}.\n", key, value);
    if (of_device(steps, "software") == "yes")
        text += "\nThis is a software device: its times are those of a processor, not of a GPU.\n";
    return text;
}

Json json_of(const GpuSteps& steps, const std::vector<std::pair<std::string, std::string>>& manifest,
             const std::vector<PartResult>& parts, bool passes) {
    Json json = {{"report", "gpu"}, {"passes", passes}, {"program", Json::object()}};
    for (const auto& [key, value] : manifest) json["program"][key] = value;
    for (const GpuStep& step : steps.steps)
        json["steps"].push_back({{"name", step.name}, {"outcome", step.outcome}, {"seconds", step.seconds}});
    for (const PartResult& part : parts)
        json["parts"].push_back({{"name", part.name}, {"passes", part.passes}, {"remark", part.remark}});
    json["results"] = steps.results;
    return json;
}

} // namespace

GpuReport report_on_gpu(const std::filesystem::path& folder, const std::filesystem::path& manifest) try {
    const GpuSteps steps = read_steps(folder);
    const auto program = read_manifest(manifest);
    const std::vector<PartResult> parts = results_of_parts(steps);
    GpuReport report;
    report.passes = true;
    MarkdownTable table({"part", "outcome", "remark"});
    for (const PartResult& part : parts) {
        report.passes &= part.passes;
        table.add({part.name, part.outcome, part.remark});
    }
    report.markdown = head_of(steps, program) + "\n" + table.text();
    for (const auto text : {failures_text, parity_text, agreement_text, samplers_text, frames_text})
        report.markdown += text(steps);
    report.json = json_of(steps, program, parts, report.passes).dump(1) + "\n";
    return report;
} catch (const Json::exception& error) {
    throw std::runtime_error("results in '" + folder.string() +
                             "' are not those of the kit: " + error.what());
}

} // namespace nusselt::lab
