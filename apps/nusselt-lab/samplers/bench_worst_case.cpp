#include "bench_worst_case.h"
#include "apps/common/help.h"
#include "apps/common/interrupt.h"
#include "apps/common/print_message.h"
#include "apps/common/progress.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "base/stopwatch.h"
#include "lab/fuzzing/convergence.h"
#include "lab/fuzzing/worst_case.h"
#include "lab/fuzzing/worst_case_state.h"
#include "render_cpu/renderer.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <stdexcept>

namespace nusselt::app {

namespace {

using lab::ConvergenceRow;
using lab::WorstCaseSearch;

constexpr double kDefaultSeconds = 60;
constexpr double kSecondsBetweenSaves = 30;
/// A batch takes some tenths of a second, which is the delay of Ctrl-C.
constexpr std::uint64_t kStartsPerThread = 32;

/// The chosen searches, and the file that stores their state.
class Session {
public:
    explicit Session(const BenchWorstCaseOptions& options) : path_(options.state) {
        state_.seed = options.seed.value_or(1);
        if (path_) load(options.seed);
        for (const auto& target : lab::worst_case_targets()) {
            const auto& names = options.targets;
            if (!names.empty() && std::find(names.begin(), names.end(), target.name) == names.end()) continue;
            searches_.emplace_back(target, state_.seed);
            const lab::SearchProgress& progress = state_.targets[target.name];
            searches_.back().resume(progress.starts, progress.parameters);
        }
    }

    void save() {
        if (!path_) return;
        for (const WorstCaseSearch& search : searches_)
            state_.targets[search.target().name] = {search.starts(), search.worst().parameters};
        lab::save_search_state(*path_, state_);
    }

    std::uint64_t seed() const { return state_.seed; }
    std::vector<WorstCaseSearch>& searches() { return searches_; }

private:
    void load(const std::optional<std::uint64_t>& seed) {
        const auto loaded = lab::load_search_state(*path_);
        if (!loaded) return;
        if (seed && *seed != loaded->seed)
            throw std::runtime_error(fmt::format(
                "{}: the search in this file has seed {}, not {}; omit --seed or choose another file",
                path_->string(), loaded->seed, *seed));
        state_ = *loaded;
    }

    std::optional<std::filesystem::path> path_;
    lab::SearchState state_;
    std::vector<WorstCaseSearch> searches_;
};

/// Searches for all targets in turn until time or starts are used up, or Ctrl-C.
void search(const BenchWorstCaseOptions& options, Session& session) {
    const int threads = render_cpu::checked_thread_count(options.threads);
    tbb::task_arena arena(threads);
    const std::uint64_t block = kStartsPerThread * static_cast<std::uint64_t>(threads);
    constexpr auto kUnlimited = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t starts = options.starts.value_or(kUnlimited);
    const double unlimited = std::numeric_limits<double>::infinity();
    const double seconds = options.seconds.value_or(options.starts ? unlimited : kDefaultSeconds);

    const base::Stopwatch stopwatch;
    base::Stopwatch since_saving;
    Progress progress;
    double fraction = 0;
    while (fraction < 1 && !interrupted) {
        std::uint64_t least = kUnlimited;
        for (WorstCaseSearch& one : session.searches()) {
            if (interrupted) break;
            const std::uint64_t left = starts - std::min(starts, one.starts());
            arena.execute([&] { one.run(std::min(block, left)); });
            least = std::min(least, one.starts());
        }
        fraction =
            std::max(stopwatch.seconds() / seconds, static_cast<double>(least) / static_cast<double>(starts));
        progress.update(std::min(fraction, 1.0));
        if (since_saving.seconds() > kSecondsBetweenSaves) {
            session.save();
            since_saving = base::Stopwatch();
        }
    }
    progress.finish();
    session.save();
}

struct Convergence {
    std::string lights;
    std::vector<ConvergenceRow> rows;
};

std::vector<Convergence> measure_convergence(int count, std::uint64_t seed) {
    if (count == 0) return {};
    return {{"lines", lab::convergence_of(lab::line_errors(count, seed))},
            {"sectors", lab::convergence_of(lab::sector_errors(count, seed))}};
}

void print_tables(Session& session, const std::vector<Convergence>& convergence) {
    fmt::print("{:<16}{:<38}{:>12}{:>14}{:>12}\n", "target", "lights", "starts", "worst error", "bound");
    for (const WorstCaseSearch& one : session.searches()) {
        fmt::print("{:<16}{:<38}{:>12}{:>14.5e}{:>12.2e}\n", one.target().name, one.target().description,
                   one.starts(), one.worst().error, one.target().bound);
        for (std::size_t i = 0; i < one.worst().parameters.size(); ++i)
            fmt::print("    {:<14}{:<30}{:.9g}\n", one.target().parameter_names[i],
                       lab::hexadecimal(one.worst().parameters[i]), one.worst().parameters[i]);
    }
    const auto cell = [](double value, std::size_t cases) {
        return cases == 0 ? fmt::format("{:>24}", "-") : fmt::format("{:>12.3f} ({:>8})", value, cases);
    };
    if (convergence.empty()) return;
    fmt::print(
        "\nMedians over random lights (conclusive cases). digits: log(e_k) / log(e_k-1); order: the same\n"
        "without the constant factor, log(e_k / e_k-1) / log(e_k-1 / e_k-2).\n\n"
        "{:<10}{:>6}{:>12}{:>24}{:>24}\n",
        "lights", "steps", "error", "digits", "order");
    for (const Convergence& c : convergence)
        for (const ConvergenceRow& row : c.rows)
            fmt::print("{:<10}{:>6}{:>12.1e}{}{}\n", c.lights, row.steps, row.median_error,
                       cell(row.digit_factor, row.digit_cases), cell(row.order, row.order_cases));
}

lab::Results results_of(Session& session, const std::vector<Convergence>& convergence) {
    lab::ResultTable targets = {"targets", {{"target"}, {"lights"}, {"starts"}, {"error"}, {"bound"}}};
    lab::ResultTable parameters = {"parameters", {{"target"}, {"parameter"}, {"value"}, {"hexadecimal"}}};
    for (const WorstCaseSearch& one : session.searches()) {
        const std::string target = one.target().name;
        targets.rows.push_back({target, one.target().description, one.starts(),
                                static_cast<double>(one.worst().error),
                                static_cast<double>(one.target().bound)});
        for (std::size_t i = 0; i < one.worst().parameters.size(); ++i) {
            const long double value = one.worst().parameters[i];
            parameters.rows.push_back({target, one.target().parameter_names[i], static_cast<double>(value),
                                       lab::hexadecimal(value)});
        }
    }
    lab::ResultTable orders = {"convergence",
                               {{"lights"},
                                {"steps"},
                                {"median_error"},
                                {"digit_factor"},
                                {"digit_cases"},
                                {"order"},
                                {"order_cases"}}};
    // Without cases that tell, the median has no meaning.
    const auto cell = [](auto value, std::size_t cases) { return cases > 0 ? lab::Cell(value) : nullptr; };
    for (const Convergence& c : convergence)
        for (const ConvergenceRow& row : c.rows)
            orders.rows.push_back({c.lights, row.steps, row.median_error,
                                   cell(row.digit_factor, row.digit_cases),
                                   cell(row.digit_cases, row.digit_cases), cell(row.order, row.order_cases),
                                   cell(row.order_cases, row.order_cases)});
    return {"worst-case",
            {{"seed", session.seed()}, {"mantissa_bits", std::numeric_limits<long double>::digits}},
            {std::move(targets), std::move(parameters), std::move(orders)}};
}

} // namespace

int run_bench_worst_case(const BenchWorstCaseOptions& options) {
    check_json_option(options.json);
    Session session(options);
    const InterruptGuard guard;
    // Fails now rather than after hours if the file cannot be written.
    session.save();
    search(options, session);

    const auto convergence = measure_convergence(interrupted ? 0 : options.convergence, session.seed());
    write_results(options.json, results_of(session, convergence),
                  [&] { print_tables(session, convergence); });
    const bool holds = std::all_of(session.searches().begin(), session.searches().end(),
                                   [](const auto& one) { return one.worst().error <= one.target().bound; });
    if (interrupted) return interrupted_exit_code();
    if (!holds) print_message("nusselt-lab: error: a worst case exceeds the documented bound\n");
    return holds ? 0 : 1;
}

void setup_bench_worst_case(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchWorstCaseOptions>();
    CLI::App* command = bench.add_subcommand(
        "worst-case", "Search for the largest backward errors of the iterations by Nelder-Mead in double and "
                      "long double, and measure "
                      "their order of convergence. Exits with 1 if an error exceeds the documented bound.");
    std::vector<std::string> names;
    for (const auto& target : lab::worst_case_targets()) names.push_back(target.name);
    command->add_option("--target", options->targets, "Target of the search. May be repeated")
        ->transform(to_one_of(names))
        ->default_str("all");
    command->add_option("--time", options->seconds, "Seconds to search, shared by the targets")
        ->check(seconds())
        ->default_str("60, or no limit with --starts");
    command
        ->add_option(
            "--starts", options->starts,
            "Starts per target, including those in the state file; the result then depends only on the seed")
        ->transform(to_whole_number(1, 1'000'000'000'000))
        ->default_str("as many as the time allows");
    command->add_option("--seed", options->seed, "Seed of the search")
        ->transform(to_whole_number(0, UINT64_MAX))
        ->default_str("that of the state file, else 1");
    add_threads_option(*command, options->threads);
    command
        ->add_option(
            "--state", options->state,
            "Store the state of the search in this file, also upon Ctrl-C, and continue from it if it exists")
        ->type_name("FILE")
        ->default_str(kNone)
        ->group(kOutputGroup);
    command
        ->add_option("--convergence", options->convergence,
                     "Random lights for the order of convergence; 0 skips it")
        ->transform(to_whole_number(0, 1'000'000));
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_worst_case(*options); });
}

} // namespace nusselt::app
