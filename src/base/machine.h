#pragma once
/// Describes the machine and the process, on which measurements depend.

#include <string>

namespace nusselt::base {

/// The name of the processor as the system reports it; empty if it reports none.
std::string processor_name();

/// The command line of this process as one would type it, with the name of the program instead of its path.
std::string command_line();

} // namespace nusselt::base
