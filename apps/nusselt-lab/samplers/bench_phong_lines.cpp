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

/// One way to integrate.
struct Method {
    const char* name;
    lab::PhongMethod lab::PhongLineComparison::*member;
};
constexpr Method kMethods[] = {
    {"packs", &lab::PhongLineComparison::packed_quadrature},
    {"scalar", &lab::PhongLineComparison::quadrature},
    {"table", &lab::PhongLineComparison::table},
    {"recursion", &lab::PhongLineComparison::recursion},
};

} // namespace

void setup_bench_phong_lines(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchPhongLinesOptions>();
    CLI::App* command =
        bench.add_subcommand("phong-lines", "Time and error of Phong lobes along parts of lines, by "
                                            "exponent. Compares quadrature (in packs and scalar) "
                                            "with the table and the recursion of Billen and Dutre (2016). "
                                            "Per part, float, one thread. Errors, median and "
                                            "largest, over the integral along the whole line.");
    add_repetitions_option(*command, options->repetitions);
    add_isa_option(*command, options->isa);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_phong_lines(*options); });
}

int run_bench_phong_lines(const BenchPhongLinesOptions& options) {
    check_json_option(options.json);
    const base::Isa isa = base::choose_isa(options.isa);
    const int lanes = lab::compare_phong_lines(1, 1, isa).lanes;
    std::string text = fmt::format("packs of {}, {}\n{:>8}", lanes, name_of(isa), "exponent");
    lab::ResultTable table = {"phong_lines", {{"exponent"}}};
    for (const Method& method : kMethods) {
        text += fmt::format("{:>30}", fmt::format("{} [ns], errors", method.name));
        table.columns.push_back({fmt::format("{}_ns", method.name), "ns"});
        table.columns.push_back({fmt::format("{}_median_error", method.name)});
        table.columns.push_back({fmt::format("{}_largest_error", method.name)});
    }
    text += "\n";
    for (const int exponent : kExponents) {
        const lab::PhongLineComparison row = lab::compare_phong_lines(exponent, options.repetitions, isa);
        text += fmt::format("{:>8}", exponent);
        table.rows.push_back({exponent});
        for (const Method& method : kMethods) {
            const lab::PhongMethod& m = row.*method.member;
            text += fmt::format("{:>12.1f}{:>9.1e}{:>9.1e}", m.nanoseconds, m.median_error, m.largest_error);
            table.rows.back().insert(table.rows.back().end(),
                                     {m.nanoseconds, m.median_error, m.largest_error});
        }
        text += "\n";
    }
    const lab::Results results = {
        "phong-lines",
        {{"repetitions", options.repetitions}, {"isa", std::string(name_of(isa))}, {"lanes", lanes}},
        {std::move(table)}};
    write_results(options.json, results, [&] { fmt::print("{}", text); });
    return 0;
}

} // namespace nusselt::app
