#pragma once
/// The fixed targets for the accuracy tables.

#include "lab/accuracy/accuracy.h"

#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

enum class AccuracyQuantity {
    p99_over_floor,  ///< 99 % backward error over that of the floor
    p999_over_floor, ///< 99.9 % backward error over that of the floor
    p99_over_other,  ///< 99 % backward error over that of another class of lights
    p99,             ///< 99 % backward error
    max,             ///< largest backward error
    max_of_measure,  ///< largest relative error of the measure
    off_the_light,   ///< count
    invalid,         ///< count of lights with results that are NaN, infinite or negative
    spurious,        ///< count of dark lights with a sample or measure
};

/// "at most 10 x the floor (99 %)" and the like.
std::string describe(AccuracyQuantity quantity, const char* other, double limit);

struct AccuracyTarget {
    const char* technique;
    const char* scalar; ///< "float": the larger value of scalar code and packs; "long double": two steps
    const char* lights; ///< a class, or kEveryClass for the largest value of all classes
    AccuracyQuantity quantity;
    double limit;           ///< largest value allowed
    const char* other = ""; ///< the class to compare with
};

inline constexpr const char* kEveryClass = "every class";

struct AccuracyVerdict {
    AccuracyTarget target;
    double value = 0;   ///< NaN if there is no such row
    std::string lights; ///< the class that has it
    bool met = false;
};

/// Checks each target against the rows, in the order of the table of targets.
std::vector<AccuracyVerdict> check_targets(const std::vector<proof::AccuracyRow>& rows);

/// The lights of the target. If it concerns every class, also the worst one.
std::string where(const AccuracyVerdict& verdict);

/// Backward errors of a row over those of the floor, for the same lights; none without a floor.
struct FloorRatios {
    std::optional<double> p99, p999;
};
FloorRatios floor_ratios(const std::vector<proof::AccuracyRow>& rows, const proof::AccuracyRow& row);

} // namespace nusselt::lab
