#pragma once
/// What reports consist of, as JSON.

#include "experiments/noise_curve.h"
#include "experiments/report_table.h"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace nusselt::experiments {

/// A list of objects.
nlohmann::ordered_json to_json(const std::vector<ExpectationResult>& expectations);

/// A list of objects.
nlohmann::ordered_json to_json(const NoiseCurve& curve);

} // namespace nusselt::experiments
