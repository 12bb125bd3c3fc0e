#pragma once
/// What reports consist of, as JSON.

#include "lab/errors/noise_curve.h"
#include "lab/figures/report_table.h"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace nusselt::lab {

/// A list of objects.
nlohmann::ordered_json to_json(const std::vector<ExpectationResult>& expectations);

/// A list of objects.
nlohmann::ordered_json to_json(const NoiseCurve& curve);

} // namespace nusselt::lab
