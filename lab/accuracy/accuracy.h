#pragma once
/// Accuracy of samplers in each number type, relative to the exact technique in long double.

#include "proof/accuracy/row.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::lab {

/// The name of the suite in techniques.json.
struct AccuracySuite {
    static constexpr std::string_view kName = "accuracy";
};

struct AccuracySettings {
    int count = 1;                  ///< lights per class, at least 1; each gets one sample
    std::optional<std::string> isa; ///< instruction set of the packs, as for base::choose_isa()
};

struct AccuracyTable {
    int count = 0;   ///< lights per class
    std::string isa; ///< of the packs
    std::vector<proof::AccuracyRow> rows;
};

/// Measures every technique on every class of lights, on all cores. Deterministic.
/// \throws std::runtime_error for an instruction set that is unknown or that the CPU lacks.
AccuracyTable measure_accuracy(const AccuracySettings& settings);

} // namespace nusselt::lab
