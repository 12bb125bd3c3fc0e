#pragma once
/// Collects the errors of one row of the accuracy tables.

#include <nusselt/core/vec.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::proof {

/// Quantiles of an error, to three digits.
struct ErrorQuantiles {
    double median = 0;
    double p99 = 0;
    double p999 = 0;
    double max = 0;
};

/// The errors of one method on one class of lights. Shares are relative to `count`.
struct AccuracyRow {
    std::string technique; ///< class name
    std::string scalar;    ///< "float", "double" or "long double"
    std::string lights;    ///< class of configurations
    /// "plain": the formulas of the papers as printed; "ours"; "ours, packs": compiled for the largest
    /// instruction set, as it is timed; "ours, 2 steps": in long double with as many steps as float takes;
    /// "floor": exact directions rounded to the number type.
    std::string method;
    std::int64_t count = 0; ///< number of lights, without those with a measure below 1e-12
    bool dark = false;      ///< nothing to sample: measure() must be 0, without samples
    /// Change of the first random number that explains the direction: the backward error (Peters 2021).
    ErrorQuantiles backward;
    /// Relative error of measure(), or measure() itself for dark lights. The floor has none.
    ErrorQuantiles measure;
    std::int64_t off_the_light = 0; ///< directions that miss the light by more than four roundings
    std::int64_t no_sample = 0;     ///< lights without a sample; 0 for dark lights
    std::int64_t spurious = 0;      ///< dark lights with a sample or a measure
    std::int64_t nan = 0;           ///< lights with a direction, density or measure that is NaN
    std::int64_t infinite = 0;      ///< lights with an infinite direction, density or measure, but no NaN
    std::int64_t negative = 0;      ///< lights with a negative density or measure
};

/// The number type of the reference.
using Exact = long double;

/// The results of a technique for one light, widened without rounding.
struct Outcome {
    Vec3<Exact> wi;
    Exact pdf, measure;
};

class AccuracyRowBuilder {
public:
    /// \param row holds the names, and whether the lights are dark.
    explicit AccuracyRowBuilder(AccuracyRow row) : row_(std::move(row)) {}

    /// Counts a light, and its results that are NaN, infinite or negative.
    /// \return whether there are no such results, so that the errors may be added.
    bool add_light(const Outcome& outcome);

    /// To be called for dark lights instead of the functions below.
    /// \param measures_light false if measure() does not depend on what the shading point sees.
    void add_dark(const Outcome& outcome, bool measures_light);

    void add_measure(Exact measured, Exact exact);

    /// \param missed_by angle by which the direction misses the light.
    /// \param tolerance largest such angle that does not count as off the light.
    void add_direction(Exact backward_error, Exact missed_by, Exact tolerance);

    void add_no_sample() { ++row_.no_sample; }

    AccuracyRow finished();

private:
    AccuracyRow row_;
    std::vector<double> backward_, measure_;
};

} // namespace nusselt::proof
