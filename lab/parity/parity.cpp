#include "lab/parity/parity.h"

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
constexpr const char* kTiny = "a rounding of the direction is a large part of the light as it is seen";
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
    {"1 mm at 40 m: second inverse, tail", kTiny},
    {"cylinder of 1 cm at 40 m: density, tail", kSilhouette},
    {"cylinder of 1 cm at 40 m: density of the sample, tail", kSilhouette},
};

} // namespace

const char* reason_of_vacuous_budget(const std::string& where) {
    for (const VacuousBudget& budget : kVacuousBudgets)
        if (where == budget.where) return budget.reason;
    return nullptr;
}

std::vector<ParityCase> parity_cases() {
    std::vector<ParityCase> cases;
    for (const auto add : {add_technique_cases, add_textured_cases, add_textured_line_cases,
                           add_environment_cases, add_windowed_cases, add_vertex_bound_cases,
                           add_function_cases, add_ltc_cases, add_estimate_cases, add_random_cases})
        add(cases);
    return cases;
}

} // namespace nusselt::parity
