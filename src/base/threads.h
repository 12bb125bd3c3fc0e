#pragma once

namespace nusselt::base {

/// Fails unless the system starts this many threads, the calling one included. oneTBB ends the program where it cannot
/// start a thread.
/// \throws std::runtime_error with the number of threads that the system starts
void check_threads(int count);

} // namespace nusselt::base
