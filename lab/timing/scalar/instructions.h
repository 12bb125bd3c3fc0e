#pragma once
/// Counts instructions without counters of the hardware, which virtual machines often lack.

#include <optional>

namespace nusselt::lab {

/// The number of instructions that a function executes. The processor stops after each one, which takes about 30 us.
/// \returns nothing on machines where this does not work; today it does on Linux for x86-64.
std::optional<long> count_instructions(void (*function)(int first, int count), int first, int count);

} // namespace nusselt::lab
