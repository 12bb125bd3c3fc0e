#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_device.h"
#include "apps/nusselt-lab/bench/bench_output.h"
#include "apps/nusselt-lab/gpu/gpu.h"

#include "gpu/fused_fma.h"
#include "lab/parity/parity.h"
#include "lab/parity/vulkan_platform.h"
#include "lab/timing/llvmpipe_threads.h"

#include <fmt/core.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace nusselt::app {

namespace {

using parity::ParityCase;
using parity::VariantVerdict;

struct Options {
    parity::ParityEffort effort;
    std::string only;
    std::optional<std::string> device, json;
};

/// What was found on one case.
struct Finding {
    const ParityCase* of;
    std::vector<VariantVerdict> verdicts;
};

/// The quantities whose errors are reported for each class of lights.
bool is_reported(const parity::Compared& row) {
    return row.quantile == "99 %" && (row.quantity == "first random number" || row.quantity == "measure");
}

void print(const Finding& finding) {
    for (const auto& [variant, verdict] : finding.verdicts) {
        fmt::print("{:<18}{:<36}{:<25}{:>8}{:>7.2f}  {}\n", finding.of->subject, finding.of->name,
                   name_of(variant), verdict.lights, verdict.largest_ratio,
                   verdict.excesses.empty() ? verdict.where : "FAILED");
        for (const std::string& excess : verdict.excesses) fmt::print("    {}\n", excess);
    }
    std::fflush(stdout); // whoever reads along sees how far it is
}

lab::Results results_of(const std::vector<Finding>& findings, const Options& options,
                        const gpu::Device& device) {
    lab::Results results = {"parity",
                            device_settings(device.description(), device.pass_clock(),
                                            lab::llvmpipe_threads(device.description())),
                            {}};
    results.settings.insert(results.settings.end(),
                            {{"lights", options.effort.lights}, {"fused_fma", gpu::has_fused_fma(device)}});
    lab::ResultTable cases = {
        "parity", {{"subject"}, {"name"}, {"variant"}, {"lights"}, {"ratio"}, {"where"}, {"failures"}}};
    lab::ResultTable failures = {"failures", {{"subject"}, {"name"}, {"variant"}, {"message"}}};
    lab::ResultTable accuracy = {
        "accuracy", {{"subject"}, {"name"}, {"variant"}, {"lights"}, {"quantity"}, {"device"}, {"cpp"}}};
    for (const Finding& finding : findings)
        for (const auto& [variant, verdict] : finding.verdicts) {
            const std::vector<lab::Cell> key{finding.of->subject, finding.of->name, name_of(variant)};
            const auto add = [&](lab::ResultTable& table, std::initializer_list<lab::Cell> cells) {
                table.rows.push_back(key);
                table.rows.back().insert(table.rows.back().end(), cells);
            };
            add(cases, {verdict.lights, verdict.largest_ratio, verdict.where,
                        static_cast<std::uint64_t>(verdict.excesses.size())});
            for (const std::string& excess : verdict.excesses) add(failures, {excess});
            for (const parity::Compared& row : verdict.compared)
                if (!row.lights.empty() && is_reported(row))
                    add(accuracy, {row.lights, row.quantity, row.device, row.cpp});
        }
    results.tables = {std::move(cases), std::move(failures), std::move(accuracy)};
    return results;
}

int run(const Options& options) {
    check_json_option(options.json);
    const gpu::Device device({.choice = options.device});
    const parity::VulkanPlatform platform(device);
    const std::vector<ParityCase> cases = parity::parity_cases();
    std::vector<Finding> findings;
    bool passes = true;
    for (const ParityCase& one : cases) {
        if ((one.subject + ", " + one.name).find(options.only) == std::string::npos) continue;
        const Finding& finding = findings.emplace_back(Finding{&one, one.judge(platform, options.effort)});
        for (const VariantVerdict& result : finding.verdicts) passes &= result.verdict.excesses.empty();
        if (options.json != "-") print(finding);
    }
    if (findings.empty())
        throw std::runtime_error("no comparison's name contains '" + options.only +
                                 "'; without --only, all are listed");
    write_results(options.json, results_of(findings, options, device), [&] {
        fmt::print("{}\n", passes ? "All errors are within three times those of C++."
                                  : "Some errors are above three times those of C++.");
    });
    return passes ? 0 : 1;
}

} // namespace

void setup_gpu_parity(CLI::App& gpu, int& exit_code) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = gpu.add_subcommand(
        "parity",
        "Errors of the techniques in GLSL, and of the functions below them, on a device. They may be at most "
        "three times those of C++ in float. Prints the largest ratio of each, and where it is; exits with 1 "
        "if one is larger. Where the device rounds fma once, shaders that use this are compared too.");
    command->add_option("--lights", options->effort.lights, "Random lights for each technique")
        ->transform(to_whole_number(parity::kFewestLights, 100'000'000));
    command->add_option("--only", options->only, "Only comparisons whose name contains this text")
        ->type_name("PART")
        ->default_str("all");
    add_device_option(*command, options->device);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

} // namespace nusselt::app
