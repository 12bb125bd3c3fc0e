#pragma once

#include <chrono>

namespace nusselt::base {

/// Measures wall-clock time from its construction on.
class Stopwatch {
public:
    /// Since the construction [s].
    double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_ = Clock::now();
};

} // namespace nusselt::base
