#include "technique_parity.h"

#include <iostream>

namespace nusselt::parity {

namespace {

/// A budget that no error can exceed, because the error of C++ is at least a third of the largest possible error.
struct VacuousBudget {
    const char* where; ///< class of lights, quantity and quantile
    const char* reason;
};

constexpr const char* kCorner = "samples next to the corner where all triangles meet: a rounding of the "
                                "direction passes from one to another";
constexpr const char* kForeshortened =
    "a rounding of the direction is a large part of the line as it is seen";
constexpr const char* kSilhouette =
    "a sample in a thousand is so close to the silhouette that its rounded direction "
    "misses the light, where the exact density is 0";
constexpr const char* kBias =
    "the bias, which such a technique has by design, is up to half the largest possible error";
constexpr VacuousBudget kVacuousBudgets[] = {
    {"close to the interior, 1e-3 of the size: first random number, far tail", kBias},
    {"square of 1 cm at 40 m: first random number, largest", kCorner},
    {"square of 1 mm at 40 m: first random number, largest", kCorner},
    {"square of 1 mm at 40 m: second random number, tail", kCorner},
    {"pointing at the point within 1e-4: first random number, largest", kForeshortened},
    {"pointing at the point within 1e-4: first random number, far tail", kForeshortened},
    {"cylinder of 1 cm at 40 m: density, tail", kSilhouette},
    {"cylinder of 1 cm at 40 m: density of the sample, tail", kSilhouette},
};

} // namespace

void expect_parity(const Verdict& verdict) {
    for (const std::string& excess : verdict.excesses) ADD_FAILURE() << excess;
    for (const std::string& where : verdict.vacuous) {
        const auto* known = std::find_if(std::begin(kVacuousBudgets), std::end(kVacuousBudgets),
                                         [&](const auto& budget) { return where == budget.where; });
        if (known == std::end(kVacuousBudgets))
            ADD_FAILURE() << "a budget that cannot fail: " << where;
        else
            std::cout << fmt::format("cannot fail: {} ({})\n", where, known->reason);
    }
    std::cout << fmt::format("largest ratio to C++: {:.2f}, {}; {} budgets cannot fail\n",
                             verdict.largest_ratio, verdict.where, verdict.vacuous.size());
}

} // namespace nusselt::parity
