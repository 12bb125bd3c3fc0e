#pragma once
/// Checks which files a program writes.

#include <filesystem>
#include <vector>

namespace nusselt::base {

/// \throws std::runtime_error if outputs would overwrite each other or an input, also by way of links
void check_distinct(const std::vector<std::filesystem::path>& outputs,
                    const std::vector<std::filesystem::path>& inputs);

} // namespace nusselt::base
