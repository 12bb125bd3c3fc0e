#pragma once
/// Checks of the files that a program is to read and to write, before it starts to work.

#include <filesystem>
#include <vector>

namespace nusselt::base {

/// \throws std::runtime_error naming all files that do not exist
void check_exist(const std::vector<std::filesystem::path>& files);

/// \throws std::runtime_error if outputs would overwrite each other or an input, also by way of links
void check_distinct(const std::vector<std::filesystem::path>& outputs,
                    const std::vector<std::filesystem::path>& inputs);

} // namespace nusselt::base
