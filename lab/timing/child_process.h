#pragma once
/// Runs other programs and measures their memory.

#include <cstdint>
#include <string>
#include <vector>

namespace nusselt::lab {

struct ChildResult {
    std::string output; ///< standard output
    /// Largest resident memory. At least as much as this process had when it started the child.
    std::uint64_t peak_bytes{};
};

/// Runs a program to its end. It inherits standard error.
/// \param command  path of the program and its arguments
/// \throws std::runtime_error if it cannot be run or fails
ChildResult run_child(const std::vector<std::string>& command);

} // namespace nusselt::lab
