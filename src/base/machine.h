#pragma once
/// Describes the machine and the process, on which measurements depend.

#include <string>
#include <vector>

namespace nusselt::base {

/// The name of the processor as the system reports it; empty if it reports none.
std::string processor_name();

/// The command line of this process as one would type it, with the name of the program instead of its path.
std::string command_line();
/// The same for given arguments, the first of which is the path of the program. Programs that have libraries of their own are
/// started by the loader: `ld-linux-x86-64.so.2 --library-path DIR PROGRAM ...`.
std::string command_line_of(const std::vector<std::string>& arguments);

} // namespace nusselt::base
