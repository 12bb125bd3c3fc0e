/// Ends a test program on a CPU without the instructions that the other sources of the program are compiled
/// for. This file is compiled for the baseline and runs before the static initialisers of the others, which
/// may already use those instructions.

#include <cstdio>
#include <cstdlib>

namespace {

[[gnu::constructor(101)]] void require_isa() {
    __builtin_cpu_init();
    if (NUSSELT_CPU_HAS_ISA) return;
    // This output works as a list of tests and as the result of a test, so CTest reports a skipped test instead of
    // none.
    std::puts(
        "RequiredInstructionSet.\n  CpuHasIt\n[  SKIPPED ] this CPU lacks an instruction set of the test");
    std::fflush(stdout);
    std::_Exit(0);
}

} // namespace
