#pragma once
/// Runs programs to measure them from outside.

#include <cstdint>
#include <string>
#include <vector>

namespace nusselt::lab {

struct ChildResult {
    std::string output; ///< standard output
    /// Largest resident memory; at least what this process had allocated itself when it started the child.
    std::uint64_t peak_bytes{};
};

/// Runs a program to its end; its errors go where ours go.
/// \param command  path of the program and its arguments
/// \throws std::runtime_error if it cannot be run or fails
ChildResult run_child(const std::vector<std::string>& command);

} // namespace nusselt::lab
