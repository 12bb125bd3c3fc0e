#include "bench_line_efficiency.h"
#include "apps/common/line_options.h"
#include "apps/common/render_setup.h"
#include "apps/common/validators.h"
#include "apps/nusselt-lab/bench/bench_output.h"

#include "lab/figures/report_json.h"
#include "lab/lines/line_efficiency.h"
#include "scene/import/importers.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

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

void print_order(const char* title, const NoiseCurve& curve) {
    constexpr int kFirst = 4;
    if (curve.back().count > kFirst)
        fmt::print("order of {} from {} to {}: {:.2f}\n", title, kFirst, curve.back().count,
                   lab::fitted_order(curve, kFirst, curve.back().count));
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
                   ? fmt::format("the choice takes up to {:.2f} times as long as the better of both", loss)
                   : "the choice cannot be judged: all its times are extrapolated");
}

std::string to_json(const std::vector<ThreadsResult>& results, const BenchLineEfficiencyOptions& options,
                    const lab::LineEfficiencySettings& settings, const scene::Scene& scene, base::Isa isa) {
    auto list = nlohmann::ordered_json::array();
    for (const ThreadsResult& result : results) {
        auto rows = nlohmann::ordered_json::array();
        for (const EqualErrorRow& row : equal_error_rows(result.efficiency))
            rows.push_back({{"points", row.points},
                            {"variance", row.variance},
                            {"points_seconds", row.points_seconds},
                            {"lines_seconds", row.lines_seconds},
                            {"lines_are_extrapolated", row.lines_are_extrapolated},
                            {"choice_seconds", row.choice_seconds},
                            {"choice_is_extrapolated", row.choice_is_extrapolated}});
        list.push_back({{"threads", result.threads},
                        {"mean_radiance", result.efficiency.mean},
                        {"points", lab::to_json(result.efficiency.points)},
                        {"lines", lab::to_json(result.efficiency.lines)},
                        {"choice", lab::to_json(result.efficiency.choice)},
                        {"equal_error", rows}});
    }
    nlohmann::ordered_json json = {{"scene", options.scene.string()},
                                   {"width", scene.film.width},
                                   {"height", scene.film.height},
                                   {"roughness", options.roughness
                                                     ? nlohmann::ordered_json(*options.roughness)
                                                     : nlohmann::ordered_json(nullptr)},
                                   {"strategies", options.strategies}};
    json.update(line_kind_json(settings.lines));
    json.update({{"most_points", options.most_points},
                 {"most_lines", options.most_lines},
                 {"repetitions", options.repetitions},
                 {"isa", name_of(isa)},
                 {"results", list}});
    // Paths may hold bytes that are not UTF-8.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
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
        "How long line samples take to the error of point samples: standard deviations over seeds, and "
        "times\n"
        "of stratified point samples (projected solid angle) and line samples in turn, and of the choice\n"
        "between both for each shading point (--many-occluders points). Times to equal errors are\n"
        "interpolated; * means that the largest number of lines was not enough, which counts neither way.\n"
        "Images should have 10^4 pixels or more: five rounds of two seeds give the standard deviation of a\n"
        "single pixel to a third.");
    command->add_option("SCENE", options->scene, "Scene file in pbrt syntax, version 3 or 4")->required();
    command
        ->add_option("--most-points", options->most_points,
                     "Point samples per pixel and light, in powers of two from 4 to this")
        ->check(CLI::Range(2 * lab::kFewestPoints, render::kMaxSamples))
        ->capture_default_str();
    command
        ->add_option("--most-lines", options->most_lines,
                     "Lines per shading point and light, in powers of two from 1 to this")
        ->check(CLI::Range(2, render::kMaxLines))
        ->capture_default_str();
    command
        ->add_option("--repetitions", options->repetitions,
                     fmt::format("Rounds of {} images of each kind, 1 to 1000", lab::kSeedsPerRound))
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->add_option("--strategies", options->strategies, "Of point samples, as for nusselt render")
        ->transform(to_name_of(render::kStrategies))
        ->capture_default_str();
    command
        ->add_option("--roughness", options->roughness,
                     "Makes all surfaces glossy: roughness, with a reflectance of 0.04 at normal incidence")
        ->check(number(0, 1));
    add_line_kind_options(*command, options->lines);
    add_machine_options(*command, options->threads, options->isa,
                        "one, then as many as the machine runs at once");
    add_resolution_option(*command, options->resolution);
    add_json_option(*command, options->json);
    command->callback([options, &exit_code] { exit_code = run_bench_line_efficiency(*options); });
}

int run_bench_line_efficiency(const BenchLineEfficiencyOptions& options) {
    const base::Isa isa = base::choose_isa(options.isa);
    scene::Scene scene = scene::load_scene(options.scene);
    apply_resolution(options.resolution, scene);
    if (options.roughness) lab::make_glossy(scene, *options.roughness);
    lab::LineEfficiencySettings settings = settings_of(options);
    std::vector<int> threads = {1, render_cpu::default_thread_count()};
    if (options.threads) threads = {*options.threads};

    if (scene.polygon_lights.empty()) throw std::runtime_error("the scene has no polygonal lights");

    std::vector<ThreadsResult> results;
    for (const int count : threads) {
        const render_cpu::Renderer renderer(scene, count);
        settings.threads = count;
        results.push_back({count, measure_line_efficiency(renderer, isa, settings, [&](int round) {
                               fmt::print(stderr, "threads {}, round {} of {}\n", count, round + 1,
                                          settings.rounds);
                           })});
        if (!(results.back().efficiency.mean > 0))
            throw std::runtime_error("the image is black: no surface faces a light");
    }
    write_results(options.json, to_json(results, options, settings, scene, isa), [&] {
        for (const ThreadsResult& result : results) print_table(result);
    });
    return 0;
}

} // namespace nusselt::app
