#pragma once
/// Options of `nusselt render` that jobs decide themselves.

#include "job.h"

#include <string>
#include <vector>

namespace nusselt::app {

struct RefusedOption {
    std::string name;    ///< such as "--part"
    std::string instead; ///< why, or what to use
};

/// \param words options behind --
/// \param more  that the kind of job refuses, too
/// \throws CLI::ValidationError naming the first one that is refused
void refuse_options(const Words& words, const std::vector<RefusedOption>& more);

} // namespace nusselt::app
