#pragma once
/// Words of commands.

#include <string>

namespace nusselt::base {

/// The word as a shell takes it: in single quotes if it has characters that a shell might interpret.
std::string shell_word(const std::string& word);

} // namespace nusselt::base
