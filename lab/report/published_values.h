#pragma once
/// The numbers that the papers print, from lab/report/published.json.

#include <optional>
#include <string>

namespace nusselt::lab {

/// \param item     id of an item
/// \param quantity as the item names it
/// \returns nothing if the paper does not print it, or if its text is not legible there
std::optional<double> published_value(const std::string& item, const std::string& quantity);

} // namespace nusselt::lab
