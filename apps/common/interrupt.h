#pragma once
/// Handles signals that ask for an early end of a long computation.

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <unistd.h>

namespace nusselt::app {

/// Whether a signal asks for the end.
inline std::atomic<bool> interrupted = false;
/// That signal.
inline std::atomic<int> interrupting_signal = SIGINT;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "signal handlers may only touch lock-free atomics");

/// The exit code by which shells report the end of a program by the signal: 130 for Ctrl-C.
inline int interrupted_exit_code() { return 128 + interrupting_signal; }

/// While this lives, the first Ctrl-C, SIGTERM (clusters that need the machine) or SIGHUP (a terminal that is closed)
/// requests a stop by `interrupted`. The second Ctrl-C ends the program; the others may come repeatedly, as they do when
/// a terminal is closed. What was ignored, as by nohup, stays ignored.
class InterruptGuard {
public:
    InterruptGuard() {
        interrupted = false;
        install(handle);
    }
    ~InterruptGuard() { install(SIG_DFL); }
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

private:
    static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

    static void install(void (*handler)(int)) {
        for (const int signal : kSignals)
            if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
    }
    static void handle(int signal) {
        interrupting_signal = signal;
        interrupted = true;
        if (signal != SIGINT) return;
        std::signal(SIGINT, SIG_DFL);
        constexpr const char* kMessage = "\nstopping; a second Ctrl-C ends the program at once\n";
        // Without a terminal nobody can be told.
        static_cast<void>(!::write(STDERR_FILENO, kMessage, std::strlen(kMessage)));
    }
};

} // namespace nusselt::app
