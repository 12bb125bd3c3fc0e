#pragma once

#include <string>

namespace nusselt::base {

/// \param target  of --json: a file, or "-" for the standard output
/// \throws std::runtime_error if the file cannot be written
void write_json(const std::string& target, const std::string& json);

} // namespace nusselt::base
