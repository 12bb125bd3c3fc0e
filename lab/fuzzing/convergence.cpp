#include "lab/fuzzing/convergence.h"

#include "proof/median.h"
#include "proof/worst_case_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nusselt::lab {

namespace {

using Real = long double;

double median_or_zero(std::vector<Real> values) {
    return values.empty() ? 0 : static_cast<double>(proof::median(std::move(values)));
}

template <class Case, int... Steps>
ErrorSequence errors_of(const Case& light, std::integer_sequence<int, Steps...>) {
    return {light.error(typename Case::template Technique<Steps>(light.light()))...};
}

template <class Case>
std::vector<ErrorSequence> random_errors(int count, std::uint64_t seed) {
    proof::RandomCoordinates random(seed, 0);
    std::vector<ErrorSequence> errors;
    while (errors.size() < static_cast<std::size_t>(count)) {
        std::array<Real, Case::kDimension> coordinates;
        for (Real& x : coordinates) x = random.uniform();
        const Case light = Case::at(coordinates);
        if (typename Case::template Technique<0>(light.light()).measure() < 1e-2L) continue;
        errors.push_back(errors_of(light, std::make_integer_sequence<int, kConvergenceSteps + 1>()));
    }
    return errors;
}

} // namespace

std::vector<ConvergenceRow> convergence_of(const std::vector<ErrorSequence>& errors) {
    constexpr Real kSmallest = 1e4L * std::numeric_limits<Real>::epsilon();
    constexpr Real kLargest = 0.1L;
    std::vector<ConvergenceRow> rows;
    for (std::size_t k = 0; k <= kConvergenceSteps; ++k) {
        std::vector<Real> after, digit_factors, orders;
        for (const ErrorSequence& e : errors) {
            after.push_back(e[k]);
            if (k < 1 || e[k] < kSmallest || e[k - 1] > kLargest) continue;
            digit_factors.push_back(std::log(e[k]) / std::log(e[k - 1]));
            if (k < 2 || e[k - 2] > kLargest || e[k - 1] >= e[k - 2]) continue;
            orders.push_back(std::log(e[k] / e[k - 1]) / std::log(e[k - 1] / e[k - 2]));
        }
        rows.push_back({static_cast<int>(k), median_or_zero(after), median_or_zero(digit_factors),
                        digit_factors.size(), median_or_zero(orders), orders.size()});
    }
    return rows;
}

std::vector<ErrorSequence> line_errors(int count, std::uint64_t seed) {
    return random_errors<proof::LineCase<Real>>(count, seed);
}

std::vector<ErrorSequence> sector_errors(int count, std::uint64_t seed) {
    return random_errors<proof::SectorCase<Real>>(count, seed);
}

} // namespace nusselt::lab
