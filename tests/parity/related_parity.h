#pragma once
/// Parity of the published methods in shaders/nusselt/related, on lights for which they are made. On other lights, their
/// errors are arbitrary in C++, too.

#include "lab/parity/parity.h"

#include <vector>

namespace nusselt::parity {

std::vector<ParityCase> related_cases();

} // namespace nusselt::parity
