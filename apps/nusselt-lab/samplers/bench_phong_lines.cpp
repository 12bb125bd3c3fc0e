#include "bench_phong_lines.h"
#include "apps/common/render_setup.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "lab/lines/phong_lines.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>

namespace nusselt::app {

namespace {

constexpr int kExponents[] = {1, 2, 5, 10, 30, 100, 300, 1000, 3000, 10000, 30000, 100000};

void print_method(const lab::PhongMethod& method) {
    fmt::print("{:>12.1f}{:>9.1e}{:>9.1e}", method.nanoseconds, method.median_error, method.largest_error);
}

} // namespace

void setup_bench_phong_lines(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchPhongLinesOptions>();
    CLI::App* command =
        bench.add_subcommand("phong-lines", "Time and error of Phong lobes along parts of lines, by "
                                            "exponent: quadrature (in packs and scalar), and\n"
                                            "the table and recursion of Billen and Dutre (2016). Per part, "
                                            "float, one thread. Errors, median and\n"
                                            "largest, over the integral along the whole line.");
    add_repetitions_option(*command, options->repetitions);
    add_isa_option(*command, options->isa);
    command->callback([options, &exit_code] { exit_code = run_bench_phong_lines(*options); });
}

int run_bench_phong_lines(const BenchPhongLinesOptions& options) {
    const base::Isa isa = base::choose_isa(options.isa);
    fmt::print("packs of {}, {}\n", lab::compare_phong_lines(1, 1, isa).lanes, name_of(isa));
    fmt::print("{:>8}{:>30}{:>30}{:>30}{:>30}\n", "exponent", "packs [ns], errors", "scalar [ns], errors",
               "table [ns], errors", "recursion [ns], errors");
    for (const int exponent : kExponents) {
        const lab::PhongLineComparison row = lab::compare_phong_lines(exponent, options.repetitions, isa);
        fmt::print("{:>8}", exponent);
        for (const auto* method : {&row.packed_quadrature, &row.quadrature, &row.table, &row.recursion})
            print_method(*method);
        fmt::print("\n");
    }
    return 0;
}

} // namespace nusselt::app
