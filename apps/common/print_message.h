#pragma once
/// Messages to the person at the terminal.

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace nusselt::app {

/// Prints to the standard error. Unlike fmt::print(), never throws if nobody can read it, as on a full disk: a message that
/// is lost must not cost an image.
template <class... Values>
void print_message(fmt::format_string<Values...> format, Values&&... values) {
    const std::string text = fmt::format(format, std::forward<Values>(values)...);
    std::fwrite(text.data(), 1, text.size(), stderr);
}

} // namespace nusselt::app
