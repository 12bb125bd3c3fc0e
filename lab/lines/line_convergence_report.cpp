#include "lab/lines/line_convergence.h"

#include "lab/errors/curve_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nusselt::lab {

namespace {

Table order_table(const LineConvergenceResult& result) {
    Table table = {{"order of the standard deviation"}};
    for (const SceneResult& scene : result.scenes) table[0].push_back(scene.scene);
    const std::vector<ConvergenceSeries>& series = result.experiment->series;
    for (std::size_t i = 0; i < series.size(); ++i) {
        table.push_back(
            {fmt::format("{}, N = {} to {}", series[i].label, series[i].fit_first, series[i].fit_last)});
        for (const SceneResult& scene : result.scenes)
            table.back().push_back(scene.is_skipped ? "skipped"
                                                    : fmt::format("{:.2f}", scene.series[i].order));
    }
    return table;
}

/// Every other count of the series with the most counts.
std::vector<int> every_other_count(const std::vector<ConvergenceSeries>& series) {
    const auto longest = std::max_element(series.begin(), series.end(), [](const auto& a, const auto& b) {
        return a.counts.size() < b.counts.size();
    });
    std::vector<int> counts;
    for (std::size_t i = 0; i < longest->counts.size(); i += 2) counts.push_back(longest->counts[i]);
    return counts;
}

/// Root mean squares relative to the mean, times in parentheses.
Table error_table(const LineConvergenceResult& result, const SceneResult& scene) {
    const std::vector<ConvergenceSeries>& series = result.experiment->series;
    const std::vector<int> counts = every_other_count(series);
    Table table = {{scene.scene + ": RMSE / mean (ms)"}};
    for (const int count : counts) table[0].push_back(fmt::format("N = {}", count));
    table[0].insert(table[0].end(), {"bias", "bias of pixels"});
    for (std::size_t i = 0; i < series.size(); ++i) {
        std::vector<std::string> row = {series[i].label};
        for (const int count : counts) {
            row.emplace_back();
            for (const CurvePoint& p : scene.series[i].curve)
                if (p.count == count)
                    row.back() =
                        fmt::format("{:.2e} ({:.3g})", std::sqrt(p.variance) / scene.mean, 1000 * p.seconds);
        }
        row.push_back(fmt::format("{:+.1e}", scene.series[i].bias));
        row.push_back(fmt::format("{:.1e}", scene.series[i].pixel_bias));
        table.push_back(std::move(row));
    }
    table.push_back({"standard error of the reference of the biases"});
    table.back().resize(counts.size() + 2);
    table.back().push_back(fmt::format("{:.1e}", scene.reference_error));
    return table;
}

std::vector<Table> tables(const LineConvergenceResult& result) {
    std::vector<Table> all = {order_table(result)};
    for (const SceneResult& scene : result.scenes)
        if (!scene.is_skipped) all.push_back(error_table(result, scene));
    return all;
}

/// The squared error relative to the mean, with the interval that holds it with a probability of 95 %.
PlotPoint point_of(double x, const CurvePoint& p, double mean) {
    const double scale = 1 / (mean * mean);
    const double reach = 1.96 * p.variance_error;
    return {x, scale * p.variance, scale * std::max(p.variance - reach, 0.0), scale * (p.variance + reach)};
}

/// \param file the second part of the name of the file
Plot error_plot(const LineConvergence& experiment, const SceneResult& scene, const std::string& x_label,
                const std::string& file, double (*x_of)(const CurvePoint&)) {
    Plot plot = {scene.scene, scene.scene + "-" + file, x_label, "mean squared error / mean squared", {}};
    for (std::size_t i = 0; i < experiment.series.size(); ++i) {
        const auto light_samples = experiment.series[i].settings.light_samples;
        PlotCurve curve = {experiment.series[i].label,
                           {},
                           light_samples == render::LightSamples::lines ? Stroke::solid : Stroke::dashed};
        for (const CurvePoint& p : scene.series[i].curve)
            curve.points.push_back(point_of(x_of(p), p, scene.mean));
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

std::string setting(const LineConvergenceResult& result) {
    return fmt::format(
        "Images are {} pixels wide, camera rays go through their centres. Errors are standard deviations "
        "over {} seeds or more, so that no reference is needed; times are medians over them, of {} threads. "
        "The order is the slope of the standard deviation over N in logarithmic axes, a least squares fit. "
        "Biases are against '{}', the mean over all seeds with the most samples.",
        result.width, result.experiment->seeds, result.threads, result.experiment->reference);
}

Results numbers_of(const LineConvergenceResult& result) {
    ResultTable scenes = {"scenes", {{"scene"}, {"skipped"}, {"mean"}, {"reference_error"}}};
    ResultTable all = {"series",
                       {{"scene"},
                        {"series"},
                        {"samples"},
                        {"fit_first"},
                        {"fit_last"},
                        {"order"},
                        {"bias"},
                        {"pixel_bias"}}};
    ResultTable curves = {"curves", curve_columns({{"scene"}, {"series"}})};
    const std::vector<ConvergenceSeries>& series = result.experiment->series;
    for (const SceneResult& scene : result.scenes) {
        scenes.rows.push_back({scene.scene, scene.is_skipped, scene.mean, scene.reference_error});
        for (std::size_t i = 0; i < scene.series.size(); ++i) {
            const SeriesResult& s = scene.series[i];
            all.rows.push_back({scene.scene, series[i].label,
                                std::string(name_of(series[i].settings.light_samples)), series[i].fit_first,
                                series[i].fit_last, s.order, s.bias, s.pixel_bias});
            append_curve({scene.scene, series[i].label}, s.curve, scene.mean, curves);
        }
    }
    return {result.experiment->name,
            {{"width", result.width},
             {"threads", result.threads},
             {"seeds", result.experiment->seeds},
             {"reference", result.experiment->reference}},
            {std::move(scenes), std::move(all), std::move(curves)}};
}

/// The orders that the paper lists.
std::vector<Measured> measured(const LineConvergenceResult& result) {
    const std::pair<const char*, const char*> names[] = {
        {"points, independent", "points, random"},     {"points, stratified", "points, stratified"},
        {"points, Sobol'", "points, low discrepancy"}, {"lines, independent", "lines, random"},
        {"lines, stratified", "lines, stratified"},    {"lines, Sobol'", "lines, low discrepancy"}};
    std::vector<Measured> all;
    for (const SceneResult& scene : result.scenes) {
        if (scene.is_skipped) continue;
        for (std::size_t i = 0; i < scene.series.size(); ++i)
            for (const auto& [ours, theirs] : names)
                if (result.experiment->series[i].label == ours)
                    all.push_back({result.experiment->orders_item,
                                   fmt::format("{}: {}", published_name(scene.scene), theirs),
                                   scene.series[i].order});
    }
    return all;
}

std::vector<Plot> plots(const LineConvergenceResult& result) {
    const LineConvergence& experiment = *result.experiment;
    std::vector<Plot> all;
    for (const SceneResult& scene : result.scenes) {
        if (scene.is_skipped) continue;
        all.push_back(error_plot(experiment, scene, "points or lines per shading point", "samples",
                                 [](const CurvePoint& p) { return static_cast<double>(p.count); }));
        all.push_back(error_plot(experiment, scene, "time of rendering [s]", "time",
                                 [](const CurvePoint& p) { return p.seconds; }));
    }
    return all;
}

} // namespace

Report report_of(const LineConvergenceResult& result) {
    Report report = {setting(result), tables(result), result.expectations};
    report.plots = plots(result);
    report.numbers = numbers_of(result);
    report.measured = measured(result);
    for (const SceneResult& scene : result.scenes)
        report.inputs.insert(report.inputs.end(), scene.files.begin(), scene.files.end());
    return report;
}

} // namespace nusselt::lab
