#pragma once

#include <cstddef>
#include <string>

namespace nusselt::render {

/// Refuses to take more memory than the machine has. Without this, Linux would grant it and end the program once it is
/// used.
/// \param what   for the message: what needs the memory
/// \param remedy for the message: what the user can do
/// \throws std::runtime_error
void check_memory(std::size_t bytes, const std::string& what, const std::string& remedy);

} // namespace nusselt::render
