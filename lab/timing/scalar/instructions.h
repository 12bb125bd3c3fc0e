#pragma once
/// Counts instructions without counters of the hardware, which virtual machines often lack.

#include <optional>

#if defined(__linux__) && defined(__x86_64__)
#include <csignal>
#include <ucontext.h>
#endif

namespace nusselt::lab {

#if defined(__linux__) && defined(__x86_64__)

namespace detail {

constexpr greg_t kTrapFlag = 0x100;
inline volatile bool counting = false;
inline volatile long instructions = 0;

/// Called after each instruction while the trap flag is set.
inline void on_instruction(int, siginfo_t*, void* context) {
    if (counting)
        instructions = instructions + 1;
    else
        static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_EFL] &= ~kTrapFlag;
}

} // namespace detail

/// The number of instructions that a function executes. The processor stops after each one, which takes about 30 us.
/// \returns nothing on machines where this does not work; today it does on Linux for x86-64.
inline std::optional<long> count_instructions(void (*function)(int first, int count), int first, int count) {
    struct sigaction action = {}, previous = {};
    action.sa_sigaction = detail::on_instruction;
    action.sa_flags = SA_SIGINFO;
    if (sigaction(SIGTRAP, &action, &previous) != 0) return std::nullopt;
    detail::instructions = 0;
    detail::counting = true;
    asm volatile("pushfq\n\torq $0x100, (%%rsp)\n\tpopfq" : : : "cc", "memory");
    function(first, count);
    detail::counting = false;
    asm volatile("nop");
    sigaction(SIGTRAP, &previous, nullptr);
    if (detail::instructions == 0) return std::nullopt;
    return detail::instructions;
}

#else

/// Nothing: this takes Linux and x86-64.
inline std::optional<long> count_instructions(void (*)(int, int), int, int) { return std::nullopt; }

#endif

} // namespace nusselt::lab
