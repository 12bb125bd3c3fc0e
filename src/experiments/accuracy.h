#pragma once
/// Accuracy of samplers in each number type, against the exact technique in long double.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::experiments {

/// Quantiles of an error, to three digits.
struct ErrorQuantiles {
    double median = 0;
    double p99 = 0;
    double p999 = 0;
    double max = 0;
};

/// How one method does on one class of lights. Shares are relative to `count`.
struct AccuracyRow {
    std::string technique; ///< class name
    std::string scalar;    ///< "float", "double" or "long double"
    std::string lights;    ///< class of configurations
    /// "plain": the formulas of the papers as printed; "ours"; "ours, packs": compiled for the largest
    /// instruction set, as it is timed; "ours, 2 steps": in long double with as many steps as float takes;
    /// "floor": exact directions rounded to the number type.
    std::string method;
    std::int64_t count = 0; ///< lights, without those of a measure below 1e-12
    bool dark = false;      ///< no light to sample: measure() must be 0 and no sample may come
    /// Change of the first random number that explains the direction: the backward error (Peters 2021).
    ErrorQuantiles backward;
    /// Relative error of measure(), for dark lights measure() itself. The floor has none.
    ErrorQuantiles measure;
    std::int64_t off_the_light = 0; ///< directions that miss the light by more than four roundings
    std::int64_t no_sample = 0;     ///< lights without a sample; none of those that are dark
    std::int64_t spurious = 0;      ///< dark lights with a sample or a measure
    std::int64_t nan = 0;           ///< lights with a direction, density or measure that is NaN
    std::int64_t infinite = 0;      ///< lights with an infinite one, but no NaN
    std::int64_t negative = 0;      ///< lights with a negative density or measure
};

struct AccuracySettings {
    int count = 1;                  ///< lights per class, at least 1; each gets one sample
    std::optional<std::string> isa; ///< of the packs; as render_cpu::choose_isa()
};

struct AccuracyTable {
    int count = 0;   ///< lights per class
    std::string isa; ///< of the packs
    std::vector<AccuracyRow> rows;
};

/// Measures every technique on every class of lights, on all cores. Deterministic.
/// \throws std::runtime_error for an instruction set that is unknown or that the CPU lacks.
AccuracyTable measure_accuracy(const AccuracySettings& settings);

} // namespace nusselt::experiments
