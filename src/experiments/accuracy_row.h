#pragma once
/// Collects the errors of one row of the accuracy tables.

#include "experiments/accuracy.h"

#include <nusselt/core/vec.h>

namespace nusselt::experiments {

/// The number type of the reference.
using Exact = long double;

/// What a technique says about one light, widened without rounding.
struct Outcome {
    Vec3<Exact> wi;
    Exact pdf, measure;
};

class AccuracyRowBuilder {
public:
    /// \param row names, and whether the lights are dark.
    explicit AccuracyRowBuilder(AccuracyRow row) : row_(std::move(row)) {}

    /// Counts a light and what is NaN, infinite or negative.
    /// \return whether nothing was: then the errors may be added.
    bool add_light(const Outcome& outcome);

    /// For dark lights instead of the functions below.
    /// \param measures_light false if measure() does not depend on what the shading point sees.
    void add_dark(const Outcome& outcome, bool measures_light);

    void add_measure(Exact measured, Exact exact);

    /// \param missed_by angle by which the direction misses the light.
    /// \param tolerance from which on it counts as off the light.
    void add_direction(Exact backward_error, Exact missed_by, Exact tolerance);

    void add_no_sample() { ++row_.no_sample; }

    AccuracyRow finished();

private:
    AccuracyRow row_;
    std::vector<double> backward_, measure_;
};

} // namespace nusselt::experiments
