#pragma once
/// The accuracy tables as text.

#include "experiments/accuracy.h"

namespace nusselt::experiments {

/// Targets, then a table per technique and number type, as Markdown with aligned columns.
std::string accuracy_tables(const AccuracyTable& table);

/// The same with an introduction: docs/accuracy.md.
std::string accuracy_page(const AccuracyTable& table);

} // namespace nusselt::experiments
