#pragma once
/// The rates at which the noise of point samples and of line samples falls: N. Billen and P. Dutre 2016, Line Sampling
/// for Direct Illumination, Figures 7 to 9 and 11 to 13.

#include "lab/errors/noise_curve.h"
#include "lab/lines/line_scenes.h"
#include "lab/report/report.h"

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace nusselt::lab {

/// One kind of sample.
struct ConvergenceSeries {
    std::string label;
    render::RenderSettings settings;
    std::vector<int> counts; ///< of points or lines, growing
    int fit_first, fit_last; ///< the order is fitted to these counts
};

/// Expects the order of a series to be in a range, in all scenes but a few.
struct OrderBetween {
    std::string series;
    double low = -std::numeric_limits<double>::infinity();
    double high = 0;
    int exceptions = 0;
};

/// Expects a series to have less noise than another with as many samples, in all scenes but a few.
struct LessNoise {
    std::string series;
    std::string than;
    int count;
    int exceptions = 0;
};

/// Expects a series to reach an error of another in less time, in all scenes but a few: the product of variance and time
/// of this many samples is less. For independent samples it is the same for all numbers.
struct LessTime {
    std::string series;
    std::string than;
    int count;
    int exceptions = 0;
};

/// Expects the orders of two series to differ by at most a tolerance, in all scenes but a few.
struct SameOrder {
    std::string series;
    std::string as;
    double tolerance;
    int exceptions = 0;
};

struct LineConvergence {
    std::string name; ///< on the command line
    std::string source;
    std::string description; ///< one sentence
    std::vector<LineScene> scenes;
    std::vector<ConvergenceSeries> series;
    std::string reference; ///< series against which biases are measured
    std::vector<OrderBetween> orders;
    std::vector<LessNoise> less_noise;
    std::vector<LessTime> less_time;
    std::vector<SameOrder> same_orders;
    std::string orders_item; ///< id of the published item with the orders
    int seeds = 16;          ///< at least; more for few samples, up to
    int most_seeds = 128;
    int width = 64; ///< of the images in pixels
};

const std::vector<LineConvergence>& all_line_convergences();

/// The first scene alone, which is no exception to anything, in small images, with up to 64 samples.
LineConvergence quick(LineConvergence experiment);

struct SeriesResult {
    NoiseCurve curve;
    double order = 0;
    /// Against the reference, both the mean over all seeds with the most samples; relative to the mean radiance.
    double bias = 0;       ///< of the mean of the image
    double pixel_bias = 0; ///< root mean square over pixels, beyond what noise explains
};

struct SceneResult {
    std::string scene;
    bool is_skipped = false;                  ///< it is not there
    std::vector<std::filesystem::path> files; ///< it was read from
    double mean = 0;                          ///< radiance of the reference
    double reference_error =
        0; ///< standard error of its pixels, root mean square, relative to the mean radiance
    std::vector<SeriesResult> series;
};

struct LineConvergenceResult {
    const LineConvergence* experiment = nullptr;
    int width = 0;
    int threads = 0;
    std::vector<SceneResult> scenes;
    std::vector<ExpectationResult> expectations;
};

/// The number of seeds for measuring the noise of a number of samples: few samples are cheap and have heavy tails.
int seeds_for(const LineConvergence& experiment, int count);

/// \throws std::runtime_error if a scene cannot be loaded
LineConvergenceResult run_line_convergence(const LineConvergence& experiment, const RunSettings& settings,
                                           const ProgressText& progress);

/// The outcomes of the expectations, over the scenes that were not skipped. Expectations whose exceptions are at least
/// half of these scenes are not evaluated, because they would expect next to nothing.
std::vector<ExpectationResult> check_expectations(const LineConvergence& experiment,
                                                  const std::vector<SceneResult>& scenes);

/// Tables of orders and errors, and plots of the error over the number of samples and over time.
Report report_of(const LineConvergenceResult& result);

} // namespace nusselt::lab
