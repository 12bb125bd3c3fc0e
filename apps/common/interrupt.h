#pragma once
/// Handles Ctrl-C during long computations.

#include <atomic>
#include <csignal>

namespace nusselt::app {

/// The exit code by which shells report the end of a program by SIGINT.
inline constexpr int kInterruptedExitCode = 130;

inline std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers may only touch lock-free atomics");

/// While this lives, the first Ctrl-C requests a stop by `interrupted`, and the second one ends the program.
class InterruptGuard {
public:
    InterruptGuard() {
        interrupted = false;
        std::signal(SIGINT, [](int) {
            interrupted = true;
            std::signal(SIGINT, SIG_DFL);
        });
    }
    ~InterruptGuard() { std::signal(SIGINT, SIG_DFL); }
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
};

} // namespace nusselt::app
