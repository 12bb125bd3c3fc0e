#include "bench_accuracy.h"

#include "base/atomic_file.h"
#include "image/io.h"
#include "lab/accuracy/accuracy_json.h"
#include "lab/accuracy/accuracy_page.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <fstream>
#include <memory>
#include <stdexcept>

namespace nusselt::app {

int run_bench_accuracy(const BenchAccuracyOptions& options) {
    if (options.markdown && options.json && *options.markdown == *options.json)
        throw std::runtime_error("--json and --markdown name the same file");
    if (options.markdown) image::check_writable(*options.markdown);
    if (options.json && *options.json != "-") image::check_writable(*options.json);
    const lab::AccuracyTable table = lab::measure_accuracy({options.count, options.isa});
    if (options.markdown)
        base::write_atomically(*options.markdown,
                               [&](std::ofstream& file) { file << lab::accuracy_page(table); });
    if (options.json && *options.json == "-") {
        fmt::print("{}", lab::to_json(table));
        return 0;
    }
    if (options.json)
        base::write_atomically(*options.json, [&](std::ofstream& file) { file << lab::to_json(table); });
    fmt::print("{}", lab::accuracy_tables(table));
    return 0;
}

void setup_bench_accuracy(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchAccuracyOptions>();
    CLI::App* command = bench.add_subcommand(
        "accuracy",
        "Errors of each technique in each number type, on classes of hard lights, against long double");
    command
        ->add_option("--count", options->count,
                     "Lights per class, 1 to 10^6; 5000 take a quarter of a minute on one core")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    command
        ->add_option(
            "--isa", options->isa,
            "Instruction set of the packs: sse42, avx2 or avx512. Default: the environment variable\n"
            "NUSSELT_ISA, else the best one that the processor supports")
        ->check(CLI::IsMember({"sse42", "avx2", "avx512"}));
    command->add_option("--markdown", options->markdown,
                        "Write the tables with an introduction to this file");
    command->add_option("--json", options->json,
                        "Write the tables as JSON to this file; - for the standard output");
    command->callback([options, &exit_code] { exit_code = run_bench_accuracy(*options); });
}

} // namespace nusselt::app
