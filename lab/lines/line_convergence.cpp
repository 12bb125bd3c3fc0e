#include "lab/lines/line_convergence.h"

#include "lab/errors/image_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace nusselt::lab {

namespace {

using render::LightSamples;
using render::LineOrientation;
using render::LineShading;
using render::SampleOrder;

constexpr int kMostPoints = 1024;
constexpr int kMostLines = 1024;
/// Lines that do not share a direction take the longest, and show their order with fewer.
constexpr int kMostTurnedLines = 256;

std::vector<int> powers_of_two(int last) {
    std::vector<int> counts;
    for (int n = 4; n <= last; n *= 2) counts.push_back(n);
    return counts;
}

/// Uniform points of the area, as in the paper.
ConvergenceSeries points(const std::string& label, SampleOrder order) {
    ConvergenceSeries series = {label, {}, powers_of_two(kMostPoints), 16, kMostPoints};
    series.settings.technique = render::Technique::area;
    series.settings.sample_order = order;
    series.settings.pixel_position = render::PixelPosition::center;
    return series;
}

/// The best points that this renderer has.
ConvergenceSeries importance_sampled_points(const std::string& label) {
    ConvergenceSeries series = points(label, SampleOrder::stratified);
    series.settings.technique = render::Technique::projected_solid_angle;
    series.settings.strategies = render::Strategies::diffuse_ltc;
    return series;
}

/// Parallel lines, sampled by length and shaded with closed forms alone, as in the paper.
ConvergenceSeries lines(const std::string& label, SampleOrder order) {
    ConvergenceSeries series = {label, {}, powers_of_two(kMostLines), 4, kMostLines};
    series.settings.light_samples = LightSamples::lines;
    series.settings.lines.shading = LineShading::analytic;
    series.settings.lines.offsets = render::LineOffsets::length;
    series.settings.lines.many_occluders = render::ManyOccluders::lines;
    series.settings.sample_order = order;
    series.settings.pixel_position = render::PixelPosition::center;
    return series;
}

std::vector<ConvergenceSeries> all_series() {
    ConvergenceSeries unbiased = lines("lines, unbiased, stratified", SampleOrder::stratified);
    unbiased.settings.lines.shading = LineShading::unbiased;
    ConvergenceSeries important = unbiased;
    important.label = "lines, by importance, stratified";
    important.settings.lines.offsets = render::LineOffsets::reflected;
    ConvergenceSeries turned = lines("lines, each turned, stratified", SampleOrder::stratified);
    turned.settings.lines.orientation = LineOrientation::independent;
    turned.counts = powers_of_two(kMostTurnedLines);
    turned.fit_last = kMostTurnedLines;
    return {points("points, independent", SampleOrder::independent),
            points("points, stratified", SampleOrder::stratified),
            points("points, Sobol'", SampleOrder::sobol),
            importance_sampled_points("points, by importance, stratified"),
            lines("lines, independent", SampleOrder::independent),
            lines("lines, stratified", SampleOrder::stratified),
            lines("lines, Sobol'", SampleOrder::sobol),
            unbiased,
            important,
            turned};
}

std::vector<OrderBetween> expected_orders() {
    constexpr double kAny = -std::numeric_limits<double>::infinity();
    // The polished floor of the logo makes noise in few pixels. What is measured of it is rough.
    return {{"points, independent", -0.55, -0.45},
            {"lines, independent", -0.55, -0.45},
            {"lines, each turned, stratified", -0.6, -0.45},
            {"points, stratified", -0.9, -0.6, 1},
            {"lines, stratified", kAny, -1.1, 1},
            {"lines, unbiased, stratified", kAny, -0.9, 1},
            {"lines, by importance, stratified", kAny, -0.9, 1}};
}

std::vector<LessNoise> expected_less_noise() {
    return {{"lines, independent", "points, independent", kMostLines},
            {"lines, stratified", "points, stratified", kMostLines},
            // Points have the lobes of polished floors for themselves: these are narrow in both dimensions.
            {"lines, by importance, stratified", "points, by importance, stratified", kMostLines, 1}};
}

std::vector<LessTime> expected_less_time() {
    // Unlike in the paper, whose lines take long since each traverses the hierarchy by itself.
    return {{"lines, independent", "points, independent", kMostLines, 1}};
}

std::vector<SameOrder> expected_same_orders() {
    // Scrambled Sobol' points are stratified in each dimension, so that they can only differ in where they are in their
    // strata. The few pixels of a polished floor make the order of the logo uncertain.
    return {{"lines, Sobol'", "lines, stratified", 0.1, 1}};
}

/// \param orders_item id in published.json
LineConvergence convergence(const std::string& name, const std::string& figures,
                            const std::string& orders_item, const std::string& lights,
                            std::vector<LineScene> scenes) {
    return {name,
            "Billen and Dutre 2016, Figures " + figures,
            "Mean squared error over the number of samples and over time, under " + lights + " lights.",
            std::move(scenes),
            all_series(),
            "points, by importance, stratified",
            expected_orders(),
            expected_less_noise(),
            expected_less_time(),
            expected_same_orders(),
            orders_item};
}

/// The mean over all seeds with the largest number of samples.
struct Converged {
    image::Image image;
    double variance; ///< of this mean
};

std::size_t index_of(const LineConvergence& experiment, const std::string& label) {
    const auto found = std::find_if(experiment.series.begin(), experiment.series.end(),
                                    [&](const ConvergenceSeries& series) { return series.label == label; });
    if (found == experiment.series.end())
        throw std::logic_error("experiment " + experiment.name + " has no series " + label);
    return static_cast<std::size_t>(found - experiment.series.begin());
}

SceneResult run_scene(const LineConvergence& experiment, const LineScene& line_scene,
                      const scene::Scene& scene, int threads, const ProgressText& progress) {
    const render_cpu::Renderer renderer(scene, threads);
    const base::Isa isa = base::choose_isa();
    SceneResult result;
    result.scene = line_scene.name;
    result.files = scene.files;
    std::vector<Converged> converged;
    const std::size_t reference = index_of(experiment, experiment.reference);
    for (const ConvergenceSeries& series : experiment.series) {
        progress(fmt::format("{}: {}", line_scene.name, series.label));
        SeriesResult measured;
        SeedStatistics statistics;
        int seeds = 0;
        for (const int count : series.counts) {
            seeds = seeds_for(experiment, count);
            statistics = render_seeds(renderer, isa, with_count(series.settings, count), seeds);
            measured.curve.push_back(
                {count, statistics.variance, statistics.seconds, seeds, statistics.variance_error});
        }
        measured.order = fitted_order(measured.curve, series.fit_first, series.fit_last);
        converged.push_back({std::move(statistics.mean), statistics.variance / seeds});
        result.series.push_back(std::move(measured));
    }
    result.mean = mean_radiance(converged[reference].image);
    result.reference_error = std::sqrt(converged[reference].variance) / result.mean;
    for (std::size_t i = 0; i < converged.size(); ++i) {
        const double noise = converged[i].variance + converged[reference].variance;
        const double square = mean_square_difference(converged[i].image, converged[reference].image);
        result.series[i].bias = mean_radiance(converged[i].image) / result.mean - 1;
        result.series[i].pixel_bias =
            i == reference ? 0 : std::sqrt(std::max(square - noise, 0.0)) / result.mean;
    }
    return result;
}

double variance_at(const NoiseCurve& curve, int count) {
    const auto found =
        std::find_if(curve.begin(), curve.end(), [&](const CurvePoint& p) { return p.count == count; });
    if (found == curve.end()) throw std::logic_error(fmt::format("no point with {} samples", count));
    return found->variance;
}

/// Of the samples of a series.
double variance_times_seconds(const NoiseCurve& curve, int count) {
    const auto found =
        std::find_if(curve.begin(), curve.end(), [&](const CurvePoint& p) { return p.count == count; });
    if (found == curve.end()) throw std::logic_error(fmt::format("no point with {} samples", count));
    return found->variance * found->seconds;
}

std::string in_all_scenes_but(int exceptions) {
    return exceptions > 0 ? fmt::format(" in all rendered scenes but {}", exceptions)
                          : " in all rendered scenes";
}

std::string to_text(const OrderBetween& e) {
    std::string text = fmt::format("order of '{}' ", e.series);
    text += std::isinf(e.low) ? fmt::format("at most {:g}", e.high)
                              : fmt::format("between {:g} and {:g}", e.low, e.high);
    return text + in_all_scenes_but(e.exceptions);
}

std::string to_text(const LessNoise& e) {
    return fmt::format("{0} of '{1}' have less noise than {0} of '{2}'", e.count, e.series, e.than) +
           in_all_scenes_but(e.exceptions);
}

std::string to_text(const LessTime& e) {
    return fmt::format("{} of '{}' have a lower variance times time than {} of '{}'", e.count, e.series,
                       e.count, e.than) +
           in_all_scenes_but(e.exceptions);
}

std::string to_text(const SameOrder& e) {
    return fmt::format("orders of '{}' and '{}' differ by at most {:g}", e.series, e.as, e.tolerance) +
           in_all_scenes_but(e.exceptions);
}

constexpr const char* kTooFewScenes = "too few scenes were rendered to allow exceptions";

} // namespace

const std::vector<LineConvergence>& all_line_convergences() {
    static const std::vector<LineConvergence> experiments = {
        convergence("lines-large", "7, 8 and 9", "line-samples-fig-9", "large", scenes_with_large_lights()),
        convergence("lines-small", "11, 12 and 13", "line-samples-fig-13", "small",
                    scenes_with_small_lights())};
    return experiments;
}

LineConvergence quick(LineConvergence experiment) {
    constexpr int kMost = 64;
    experiment.scenes.resize(1);
    experiment.width = 32;
    experiment.most_seeds = 32;
    for (ConvergenceSeries& series : experiment.series) {
        std::erase_if(series.counts, [](int count) { return count > kMost; });
        series.fit_first = 4;
        series.fit_last = kMost;
    }
    for (OrderBetween& e : experiment.orders) e.exceptions = 0;
    for (LessNoise& e : experiment.less_noise) {
        e.count = kMost;
        e.exceptions = 0;
    }
    for (LessTime& e : experiment.less_time) {
        e.count = kMost;
        e.exceptions = 0;
    }
    for (SameOrder& e : experiment.same_orders) e.exceptions = 0;
    return experiment;
}

int seeds_for(const LineConvergence& experiment, int count) {
    constexpr int kSamples = 1024;
    return std::clamp(kSamples / count, experiment.seeds, std::max(experiment.seeds, experiment.most_seeds));
}

LineConvergenceResult run_line_convergence(const LineConvergence& experiment, const RunSettings& settings,
                                           const ProgressText& progress) {
    LineConvergenceResult result;
    result.experiment = &experiment;
    result.width = experiment.width;
    result.threads = thread_count(settings);
    result.scenes = for_each_scene<SceneResult>(experiment.scenes, settings, result.width, progress,
                                                [&](const LineScene& line_scene, const scene::Scene& scene) {
                                                    return run_scene(experiment, line_scene, scene,
                                                                     result.threads, progress);
                                                });
    result.expectations = check_expectations(experiment, result.scenes);
    return result;
}

std::vector<ExpectationResult> check_expectations(const LineConvergence& experiment,
                                                  const std::vector<SceneResult>& scenes) {
    std::vector<ExpectationResult> results;
    const auto measured = std::count_if(scenes.begin(), scenes.end(),
                                        [](const SceneResult& scene) { return !scene.is_skipped; });
    const auto check = [&](const auto& expectation, const auto& holds_in) {
        if (measured <= 2 * expectation.exceptions) {
            results.push_back(not_evaluated(to_text(expectation), kTooFewScenes));
            return;
        }
        const auto violations = std::count_if(scenes.begin(), scenes.end(), [&](const SceneResult& scene) {
            return !scene.is_skipped && !holds_in(scene.series);
        });
        results.push_back(checked(to_text(expectation), violations <= expectation.exceptions));
    };
    using Series = std::vector<SeriesResult>;
    for (const OrderBetween& e : experiment.orders) {
        const std::size_t series = index_of(experiment, e.series);
        check(e, [&](const Series& s) { return s[series].order >= e.low && s[series].order <= e.high; });
    }
    for (const LessNoise& e : experiment.less_noise) {
        const std::size_t less = index_of(experiment, e.series);
        const std::size_t more = index_of(experiment, e.than);
        check(e, [&](const Series& s) {
            return variance_at(s[less].curve, e.count) < variance_at(s[more].curve, e.count);
        });
    }
    for (const LessTime& e : experiment.less_time) {
        const std::size_t less = index_of(experiment, e.series);
        const std::size_t more = index_of(experiment, e.than);
        check(e, [&](const Series& s) {
            return variance_times_seconds(s[less].curve, e.count) <
                   variance_times_seconds(s[more].curve, e.count);
        });
    }
    for (const SameOrder& e : experiment.same_orders) {
        const std::size_t one = index_of(experiment, e.series);
        const std::size_t other = index_of(experiment, e.as);
        check(e, [&](const Series& s) { return std::fabs(s[one].order - s[other].order) <= e.tolerance; });
    }
    return results;
}

} // namespace nusselt::lab
