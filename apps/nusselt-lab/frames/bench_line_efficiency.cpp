#include "bench_line_efficiency.h"
#include "apps/common/help.h"
#include "apps/common/line_options.h"
#include "apps/common/print_message.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_output.h"
#include "bench_frames.h"

#include "lab/errors/curve_table.h"
#include "lab/lines/line_efficiency.h"
#include "scene/import/importers.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::app {

namespace {

using lab::EqualErrorRow;
using lab::LineEfficiency;
using lab::NoiseCurve;

struct ThreadsResult {
    int threads;
    LineEfficiency efficiency;
};

void print_curve(const char* title, const NoiseCurve& curve, double mean) {
    fmt::print("{:<8}", title);
    for (const lab::CurvePoint& p : curve)
        fmt::print("{:>7}: {:.2e} {:.3g} ms", p.count, std::sqrt(p.variance) / mean, 1e3 * p.seconds);
    fmt::print("\n");
}

/// Fewer samples are not on the straight line.
constexpr int kFirstOfOrder = 4;

void print_order(const char* title, const NoiseCurve& curve) {
    if (curve.back().count > kFirstOfOrder)
        fmt::print("order of {} from {} to {}: {:.2f}\n", title, kFirstOfOrder, curve.back().count,
                   lab::fitted_order(curve, kFirstOfOrder, curve.back().count));
}

void print_table(const ThreadsResult& result) {
    const LineEfficiency& efficiency = result.efficiency;
    fmt::print("Threads: {}. Relative standard deviations and times:\n", result.threads);
    print_curve("points", efficiency.points, efficiency.mean);
    print_curve("lines", efficiency.lines, efficiency.mean);
    print_curve("choice", efficiency.choice, efficiency.mean);
    print_order("points", efficiency.points);
    print_order("lines", efficiency.lines);
    print_order("the choice", efficiency.choice);

    const std::vector<EqualErrorRow> rows = equal_error_rows(efficiency);
    fmt::print("\n{:>8}{:>12}{:>13}{:>14}{:>16}{:>15}\n", "points", "error", "points ms", "lines/points",
               "choice/points", "choice/better");
    for (const EqualErrorRow& row : rows)
        fmt::print("{:>8}{:>12.2e}{:>13.2f}{:>13.3f}{}{:>15.3f}{}{:>15.3f}\n", row.points,
                   std::sqrt(row.variance) / efficiency.mean, 1e3 * row.points_seconds,
                   row.lines_over_points(), row.lines_are_extrapolated ? '*' : ' ',
                   row.choice_seconds / row.points_seconds, row.choice_is_extrapolated ? '*' : ' ',
                   row.loss());
    const auto first = crossover(rows);
    const double loss = largest_loss(rows);
    fmt::print("{}; {}\n\n", first ? fmt::format("lines win from {} points", *first) : "lines do not win",
               loss > 0
                   ? fmt::format("the choice takes up to {:.2f} times as long as the better of the two", loss)
                   : "the choice cannot be judged: all its times are extrapolated");
}

lab::Results results_of(const std::vector<ThreadsResult>& results, const BenchLineEfficiencyOptions& options,
                        const lab::LineEfficiencySettings& settings, const scene::Scene& scene,
                        base::Isa isa) {
    lab::ResultTable curves = {"curves", lab::curve_columns({{"threads"}, {"samples"}})};
    lab::ResultTable orders = {"orders", {{"threads"}, {"samples"}, {"first"}, {"last"}, {"order"}}};
    lab::ResultTable rows = {"equal_error",
                             {{"threads"},
                              {"points"},
                              {"error"},
                              {"points_seconds", "s"},
                              {"lines_seconds", "s"},
                              {"lines_over_points"},
                              {"lines_mark"},
                              {"choice_seconds", "s"},
                              {"choice_over_better"},
                              {"choice_mark"},
                              {"lines_win_from"}}};
    const auto mark = [](bool is_extrapolated) { return std::string(is_extrapolated ? "*" : ""); };
    for (const auto& [threads, efficiency] : results) {
        for (const auto& [samples, curve] :
             {std::pair("points", &efficiency.points), std::pair("lines", &efficiency.lines),
              std::pair("choice", &efficiency.choice)}) {
            lab::append_curve({threads, std::string(samples)}, *curve, efficiency.mean, curves);
            if (curve->back().count > kFirstOfOrder)
                orders.rows.push_back({threads, std::string(samples), kFirstOfOrder, curve->back().count,
                                       lab::fitted_order(*curve, kFirstOfOrder, curve->back().count)});
        }
        const std::vector<EqualErrorRow> equal = equal_error_rows(efficiency);
        const auto first = crossover(equal);
        for (const EqualErrorRow& row : equal)
            rows.rows.push_back({threads, row.points, std::sqrt(row.variance) / efficiency.mean,
                                 row.points_seconds, row.lines_seconds, row.lines_over_points(),
                                 mark(row.lines_are_extrapolated), row.choice_seconds, row.loss(),
                                 mark(row.choice_is_extrapolated), lab::cell_of(first)});
    }
    lab::Results all = {"line-efficiency",
                        {{"scene", options.scene.stem().string()},
                         {"width", scene.film.width},
                         {"height", scene.film.height},
                         {"roughness", lab::cell_of(options.roughness)},
                         {"strategies", options.strategies}},
                        {}};
    append_line_kind(settings.lines, all.settings);
    all.settings.insert(all.settings.end(), {{"most_points", options.most_points},
                                             {"most_lines", options.most_lines},
                                             {"repetitions", options.repetitions},
                                             {"isa", std::string(name_of(isa))}});
    all.tables = {std::move(curves), std::move(orders), std::move(rows)};
    return all;
}

lab::LineEfficiencySettings settings_of(const BenchLineEfficiencyOptions& options) {
    lab::LineEfficiencySettings settings;
    settings.points.strategies = from_name(render::kStrategies, options.strategies);
    settings.points.sample_order = render::SampleOrder::stratified;
    settings.points.pixel_position = render::PixelPosition::center;
    apply_line_kind_options(options.lines, settings.lines);
    settings.most_points = options.most_points;
    settings.most_lines = options.most_lines;
    settings.rounds = options.repetitions;
    return settings;
}

} // namespace

void setup_bench_line_efficiency(CLI::App& bench, int& exit_code) {
    const auto options = std::make_shared<BenchLineEfficiencyOptions>();
    CLI::App* command = bench.add_subcommand(
        "line-efficiency",
        "Time that line samples need to reach the error of point samples. Measures standard deviations over "
        "seeds, and times, of stratified point samples (projected solid angle), of line samples, and of the "
        "choice between both for each shading point (--many-occluders points), interleaved. Times to equal "
        "errors are interpolated; * means that the largest number of lines was not enough, so the time does "
        "not count. Images should have 10^4 pixels or more: five rounds of two seeds give the standard "
        "deviation of a single pixel to a third.");
    add_scene_argument(*command, options->scene);
    command
        ->add_option(
            "--most-points", options->most_points,
            "Largest number of point samples per pixel and light; smaller ones are powers of two from 4")
        ->transform(to_whole_number(2 * lab::kFewestPoints, render::kMaxSamples));
    command
        ->add_option(
            "--most-lines", options->most_lines,
            "Largest number of lines per shading point and light; smaller ones are powers of two from 1")
        ->transform(to_whole_number(2, render::kMaxLines));
    command
        ->add_option("--repetitions", options->repetitions,
                     fmt::format("Rounds of {} images of each kind", lab::kSeedsPerRound))
        ->transform(to_whole_number(1, 1000));
    command
        ->add_option("--strategies", options->strategies,
                     "Strategies for point samples, as for `nusselt render`")
        ->transform(to_one_of(names_of(render::kStrategies)))
        ->group(kSamplingGroup);
    command
        ->add_option(
            "--roughness", options->roughness,
            "Make all surfaces glossy with this roughness and a reflectance of 0.04 at normal incidence")
        ->check(number(0, 1))
        ->default_str("the materials of the scene")
        ->group(kSceneGroup);
    add_line_kind_options(*command, options->lines);
    add_machine_options(*command, options->threads, options->isa, "one, then one per hardware thread");
    add_resolution_option(*command, options->resolution);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_line_efficiency(*options); });
}

int run_bench_line_efficiency(const BenchLineEfficiencyOptions& options) {
    const base::Isa isa = base::choose_isa(options.isa);
    std::vector<int> threads = {render_cpu::checked_thread_count(options.threads)};
    if (!options.threads) threads.insert(threads.begin(), 1);
    scene::Scene scene = load_scene(options.scene, options.json);
    apply_resolution(options.resolution, scene);
    if (options.roughness) lab::make_glossy(scene, *options.roughness);
    lab::LineEfficiencySettings settings = settings_of(options);

    if (scene.lights.of<scene::PolygonLight>().empty())
        throw std::runtime_error("the scene has no polygonal lights; choose one that has");

    std::vector<ThreadsResult> results;
    for (const int count : threads) {
        const render_cpu::Renderer renderer(scene, count);
        settings.threads = count;
        results.push_back({count, measure_line_efficiency(renderer, isa, settings, [&](int round) {
                               print_message("threads {}, round {} of {}\n", count, round + 1,
                                             settings.rounds);
                           })});
        if (!(results.back().efficiency.mean > 0))
            throw std::runtime_error("the image is black: no surface faces a light");
    }
    write_results(options.json, results_of(results, options, settings, scene, isa), [&] {
        for (const ThreadsResult& result : results) print_table(result);
    });
    return 0;
}

} // namespace nusselt::app
