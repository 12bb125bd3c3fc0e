#include "bench_accuracy.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "base/isa.h"
#include "lab/accuracy/accuracy_json.h"
#include "lab/accuracy/accuracy_text.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

int run_bench_accuracy(const BenchAccuracyOptions& options) {
    check_json_option(options.json);
    const lab::AccuracyTable table = lab::measure_accuracy({options.count, options.isa});
    write_results(options.json, lab::results_of(table), [&] { fmt::print("{}", lab::to_text(table)); });
    return 0;
}

void setup_bench_accuracy(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchAccuracyOptions>();
    CLI::App* command = bench.add_subcommand(
        "accuracy",
        "Errors of each technique in each number type, on classes of hard lights, against long double.");
    command->add_option("--count", options->count, "Lights per class; 5000 take 15 seconds on one core")
        ->transform(to_whole_number(1, 1'000'000));
    add_isa_option(*command, options->isa);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_accuracy(*options); });
}

} // namespace nusselt::app
