#pragma once
/// The accuracy tables as text.

#include "lab/accuracy/accuracy.h"

namespace nusselt::lab {

/// Targets, then a table per technique and number type.
std::string to_text(const AccuracyTable& table);

} // namespace nusselt::lab
