#include "proof/accuracy/row.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace nusselt::proof {

namespace {

/// Rounds to three digits, the precision of the tables and of the committed baseline.
double rounded(double x) { return std::strtod(fmt::format("{:.2e}", x).c_str(), nullptr); }

ErrorQuantiles quantiles(std::vector<double>& errors) {
    if (errors.empty()) return {};
    std::sort(errors.begin(), errors.end());
    const auto at = [&](double share) {
        return rounded(errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))]);
    };
    return {at(0.5), at(0.99), at(0.999), at(1)};
}

} // namespace

bool AccuracyRowBuilder::add_light(const Outcome& outcome) {
    const Exact values[] = {outcome.wi.x, outcome.wi.y, outcome.wi.z, outcome.pdf, outcome.measure};
    const auto any = [&](auto predicate) {
        return std::any_of(std::begin(values), std::end(values), predicate);
    };
    ++row_.count;
    const bool nan = any([](Exact x) { return std::isnan(x); });
    const bool infinite = !nan && any([](Exact x) { return std::isinf(x); });
    const bool negative = !nan && !infinite && (outcome.pdf < 0 || outcome.measure < 0);
    row_.nan += nan;
    row_.infinite += infinite;
    row_.negative += negative;
    return !nan && !infinite && !negative;
}

void AccuracyRowBuilder::add_dark(const Outcome& outcome, bool measures_light) {
    const Exact measure = measures_light ? outcome.measure : 0;
    row_.spurious += outcome.pdf > 0 || measure > 0;
    measure_.push_back(static_cast<double>(measure));
}

void AccuracyRowBuilder::add_measure(Exact measured, Exact exact) {
    measure_.push_back(static_cast<double>(std::fabs(measured / exact - 1)));
}

void AccuracyRowBuilder::add_direction(Exact backward_error, Exact missed_by, Exact tolerance) {
    // A direction of length zero has no inverse, which counts as the largest possible error.
    const bool usable = !std::isnan(backward_error) && !std::isnan(missed_by);
    backward_.push_back(usable ? static_cast<double>(backward_error) : 1.0);
    row_.off_the_light += !usable || missed_by > tolerance;
}

AccuracyRow AccuracyRowBuilder::finished() {
    row_.backward = quantiles(backward_);
    row_.measure = quantiles(measure_);
    return row_;
}

} // namespace nusselt::proof
