#pragma once
/// Words for commands and messages.

#include <string>
#include <vector>

namespace nusselt::base {

/// The word as a shell takes it: in single quotes if it has characters that a shell might interpret.
std::string shell_word(const std::string& word);

/// The words with commas between them and a conjunction before the last one, such as "a, b or c".
std::string listing(const std::vector<std::string>& words, const std::string& conjunction);

} // namespace nusselt::base
