#pragma once
/// Accuracy of samplers in single precision, against the same technique in long double.

#include <cstdint>
#include <string>
#include <vector>

namespace nusselt::experiments {

/// Quantiles of an error.
struct ErrorQuantiles {
    double median = 0;
    double p99 = 0;
    double p999 = 0;
    double max = 0;
};

/// How one method does on one class of lights.
struct AccuracyRow {
    std::string technique; ///< class name
    std::string lights;    ///< class of configurations
    /// "plain": the formulas of the papers as printed; "ours"; "floor": exact directions rounded to float.
    std::string method;
    /// Change of the first random number that explains the direction: the backward error (Peters 2021).
    ErrorQuantiles backward;
    ErrorQuantiles measure;   ///< relative error of the measure; the floor has none
    double off_the_light = 0; ///< share of directions that miss the light by more than four roundings
    double no_sample = 0;     ///< share of lights without a sample although the measure is above 1e-12
    std::int64_t invalid =
        0; ///< directions, densities or measures that are NaN or infinite, or densities below 0
};

/// Measures every class of configurations; deterministic.
/// \param count lights per class, at least 1; each gets one sample.
std::vector<AccuracyRow> measure_accuracy(int count);

} // namespace nusselt::experiments
