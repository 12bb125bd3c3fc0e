#include "lab/timing/scalar/instructions.h"

#if defined(__linux__) && defined(__x86_64__)

#include <csignal>
#include <ucontext.h>

namespace nusselt::lab {

namespace {

constexpr greg_t kTrapFlag = 0x100;
volatile bool counting = false;
volatile long instructions = 0;

/// Called after each instruction while the trap flag is set.
void on_instruction(int, siginfo_t*, void* context) {
    if (counting)
        instructions = instructions + 1;
    else
        static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_EFL] &= ~kTrapFlag;
}

} // namespace

std::optional<long> count_instructions(void (*function)(int, int), int first, int count) {
    struct sigaction action = {}, previous = {};
    action.sa_sigaction = on_instruction;
    action.sa_flags = SA_SIGINFO;
    if (sigaction(SIGTRAP, &action, &previous) != 0) return std::nullopt;
    instructions = 0;
    counting = true;
    asm volatile("pushfq\n\torq $0x100, (%%rsp)\n\tpopfq" : : : "cc", "memory");
    function(first, count);
    counting = false;
    asm volatile("nop");
    sigaction(SIGTRAP, &previous, nullptr);
    if (instructions == 0) return std::nullopt;
    return instructions;
}

} // namespace nusselt::lab

#else

namespace nusselt::lab {

std::optional<long> count_instructions(void (*)(int, int), int, int) { return std::nullopt; }

} // namespace nusselt::lab

#endif
