#pragma once
/// The work that must suffice to reject a wrong shader. The quick effort makes no less.

#include <cstddef>

namespace nusselt::parity {

inline constexpr int kMutantLights = 50'000;
inline constexpr std::size_t kMutantCalls = 60'000;

} // namespace nusselt::parity
