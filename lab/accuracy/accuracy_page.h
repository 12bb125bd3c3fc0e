#pragma once
/// The accuracy tables as text.

#include "lab/accuracy/accuracy.h"

namespace nusselt::lab {

/// Targets, then a table per technique and number type, as Markdown with aligned columns.
std::string accuracy_tables(const AccuracyTable& table);

/// The same with an introduction: docs/accuracy.md.
std::string accuracy_page(const AccuracyTable& table);

} // namespace nusselt::lab
