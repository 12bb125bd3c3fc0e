#pragma once
/// Handles signals that ask for an early end of a long computation.

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
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

/// While this lives, the first Ctrl-C or other signal that announces the end requests a stop by `interrupted`. The second
/// Ctrl-C ends the program; the others may come repeatedly, as they do when a terminal is closed. What was ignored, as by
/// nohup, stays ignored.
class InterruptGuard {
public:
    static constexpr const char* kNotice = "\nstopping; a second Ctrl-C ends the program at once\n";

    /// \param notice to print at Ctrl-C; lives as long as the program
    explicit InterruptGuard(const char* notice = kNotice) {
        stop_notice = notice;
        install(request_stop);
    }
    /// Until stop_in_order(), the first signal ends the program at once, with the exit code that interrupted_exit_code()
    /// would have: preparations that may take long have no result that could be kept.
    /// \param words to print then; lives as long as the program
    InterruptGuard(const char* notice, const char* words) {
        stop_notice = notice;
        last_words = words;
        install(end);
    }
    ~InterruptGuard() { install(SIG_DFL); }
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// From now on, signals request a stop.
    void stop_in_order() { install(request_stop); }

private:
    /// Besides Ctrl-C: clusters that need the machine send SIGTERM, terminals that are closed SIGHUP, and batch systems
    /// SIGXCPU or SIGUSR1 before they kill a job that has used up its time. SIGQUIT stays a way to end at once.
    static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1};
    static inline std::atomic<const char*> stop_notice = kNotice;
    static inline std::atomic<const char*> last_words = "";
    static_assert(std::atomic<const char*>::is_always_lock_free);

    static void install(void (*handler)(int)) {
        for (const int signal : kSignals) {
            struct sigaction present {};
            ::sigaction(signal, nullptr, &present);
            if (present.sa_handler != SIG_IGN) std::signal(signal, handler);
        }
    }
    static void request_stop(int signal) {
        interrupting_signal = signal;
        interrupted = true;
        if (signal != SIGINT) return;
        const int error_of_interrupted_call = errno;
        std::signal(SIGINT, SIG_DFL);
        print(stop_notice);
        errno = error_of_interrupted_call;
    }
    static void end(int signal) {
        print(last_words);
        std::_Exit(128 + signal);
    }
    static void print(const char* message) {
        // If the message cannot be written, nothing else can report that.
        static_cast<void>(!::write(STDERR_FILENO, message, std::strlen(message)));
    }
};

} // namespace nusselt::app
