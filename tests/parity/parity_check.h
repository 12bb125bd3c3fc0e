#pragma once
/// Budgets of the twins: errors on the device may be at most three times those of C++ in float.

#include "experiments/accuracy_cases.h"
#include "experiments/hostile/contract.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace nusselt::parity {

/// What errors are measured of, against the technique in long double.
enum class Quantity {
    first_random,  ///< backward error of the first random number
    second_random, ///< of the second one; lines have none
    measure,       ///< relative
    density,       ///< relative to that of the technique in long double in the same direction
    aim,           ///< angle between the direction and the hit point
    inverse,       ///< of the first random number that invert() finds for the direction
};
inline constexpr const char* kQuantityNames[] = {
    "first random number", "second random number", "measure", "density", "aim", "inverse"};
inline constexpr std::size_t kQuantities = std::size(kQuantityNames);

/// The errors of one method on one class of lights.
struct Errors {
    std::array<std::vector<double>, kQuantities> of;
    std::int64_t off_the_light = 0; ///< directions that miss the light by more than four roundings
    std::int64_t no_sample = 0;     ///< lights that have a measure, but no sample
    std::int64_t spurious = 0;      ///< dark lights with a sample or a measure
    std::int64_t invalid = 0;       ///< results that are NaN, infinite or negative

    void add(Quantity quantity, long double error) {
        of[static_cast<std::size_t>(quantity)].push_back(static_cast<double>(error));
    }
    void append(const Errors& other);
};

/// What came of comparing a device with C++.
struct Verdict {
    std::vector<std::string> excesses; ///< lines that say which budget is exceeded, and by how much
    double largest_ratio = 0; ///< of an error on the device to that of C++ or the floor; the budget is 3
    std::string where;        ///< the quantity and quantile with the largest ratio

    void add(const std::string& prefix, const Verdict& other);
};

/// Which errors are compared, beside the median, 99 % and 99.9 %.
enum class Tail {
    quantiles,
    /// Also the largest error. Where a quantity is hard to tell for single lights (say, the second random number at the
    /// tip of a sector), the largest error of one method may be three times that of another by chance alone.
    largest,
};

/// Compares errors of one quantity.
/// \param floor errors of the exact results rounded to float: no method can be asked for less.
Verdict compare(const std::string& quantity, std::vector<double> device, std::vector<double> cpp,
                std::vector<double> floor, Tail tail);

/// Compares all quantities, and the counts.
Verdict compare(const Errors& device, const Errors& cpp, const Errors& floor);

/// Judges what a method returns for a light.
/// \tparam Traits of src/experiments/accuracy_techniques.h.
template <class Traits, class Outputs>
void judge(const experiments::Case<Traits, float>& c, bool dark, const Outputs& out, Errors& errors) {
    using experiments::Exact;
    const auto& [sample, pdf, inverse, measure] = out;
    if (!hostile::all_finite(sample.wi) || !is_finite(sample.pdf) || !is_finite(pdf) || !is_finite(measure) ||
        sample.pdf < 0 || pdf < 0 || measure < 0 || !hostile::in_unit_interval(inverse)) {
        ++errors.invalid;
        return;
    }
    if (dark) {
        errors.spurious += sample.pdf > 0 || (Traits::kMeasuresVisible && measure > 0);
        return;
    }
    const Exact exact_measure = c.exact.measure();
    errors.add(Quantity::measure, std::fabs(measure / exact_measure - 1));
    if (sample.pdf == 0) {
        ++errors.no_sample;
        return;
    }
    const Vec3<Exact> wi = normalize(broadcast<Exact>(sample.wi));
    errors.off_the_light += c.missed_by(wi) > experiments::kTolerance<float>;
    const auto explained = c.exact.invert(wi);
    const Exact first = Traits::first(explained);
    errors.add(Quantity::first_random, c.difference(first, Traits::first(c.u)));
    errors.add(Quantity::inverse, c.difference(first, Traits::first(inverse)));
    if constexpr (!std::is_same_v<std::decay_t<decltype(c.u)>, float>)
        errors.add(Quantity::second_random, std::fabs(explained.y - c.u.y));
    errors.add(Quantity::density, std::fabs(pdf / c.exact.pdf(wi) - 1));
    errors.add(Quantity::aim, length(cross(wi, normalize(broadcast<Exact>(sample.p)))));
}

/// Exact results, rounded to float.
template <class Kind, class Traits>
hostile::Outputs<float, typename Kind::template Random<float>>
rounded_outputs(const experiments::Case<Traits, float>& c) {
    using experiments::Exact;
    const auto s = c.exact.sample(Traits::template widened<Exact>(c.u));
    const auto pdf = static_cast<float>(s.pdf);
    return {{broadcast<float>(s.wi), pdf, broadcast<float>(s.p)},
            pdf,
            c.u,
            static_cast<float>(c.exact.measure())};
}

} // namespace nusselt::parity
