#include "apps/nusselt-lab/bench/bench_device.h"
#include "apps/nusselt-lab/bench/bench_output.h"
#include "apps/nusselt-lab/gpu/gpu.h"

#include "gpu/fused_fma.h"
#include "lab/timing/llvmpipe_threads.h"

#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

namespace {

struct Options {
    std::optional<std::string> device, json;
};

int run(const Options& options) {
    check_json_option(options.json);
    const gpu::Device device({.choice = options.device});
    const auto& description = device.description();
    const auto threads = lab::llvmpipe_threads(description);
    const bool queries = device.features().ray_queries, fused = gpu::has_fused_fma(device);
    lab::Results results = {"device", device_settings(description, device.pass_clock(), threads), {}};
    results.settings.insert(
        results.settings.end(),
        {{"software", description.is_software}, {"ray_queries", queries}, {"fused_fma", fused}});
    write_results(options.json, results, [&] {
        print_device(description, device.pass_clock(), "", text_of_threads(threads));
        fmt::print("ray queries: {}\nfma: rounds {}\n", queries ? "yes" : "no", fused ? "once" : "twice");
    });
    return 0;
}

} // namespace

void setup_gpu_device(CLI::App& gpu, int& exit_code) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = gpu.add_subcommand(
        "device", "What the device supports of what Nusselt uses where it can: ray queries and a fused fma.");
    add_device_option(*command, options->device);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run(*options); });
}

} // namespace nusselt::app
