#pragma once
/// Texts for people that contain words of files, which may hold any bytes.

#include <string>
#include <string_view>

namespace nusselt::scene {

/// The shortest decimal text of a number.
std::string to_text(double value);

/// Text from a file as messages show it: an ellipsis in place of what exceeds `max_bytes`.
std::string shortened(std::string_view text, std::size_t max_bytes = 60);

/// A noun with "a" or "an".
std::string with_article(std::string_view noun);

/// A message as one line that terminals show as it is: question marks in place of control characters, and an ellipsis
/// in place of what exceeds 8000 bytes.
std::string message_line(std::string_view message);

} // namespace nusselt::scene
