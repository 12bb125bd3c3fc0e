#pragma once
/// Words for commands and messages.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::base {

/// The word as a shell takes it: in single quotes if it has characters that a shell might interpret.
std::string shell_word(const std::string& word);

/// The words with commas between them and a conjunction before the last one, such as "a, b or c".
std::string listing(const std::vector<std::string>& words, const std::string& conjunction);

/// The one of `known` that takes the fewest insertions, removals and replacements of characters to get from `word`, if so
/// few are needed that `word` may be a typing error; nothing otherwise.
std::optional<std::string> likely_meant(std::string_view word, const std::vector<std::string>& known);

} // namespace nusselt::base
