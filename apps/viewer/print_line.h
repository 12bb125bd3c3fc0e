#pragma once
/// Output of the viewer.

#include <cstdio>
#include <string>

#include <fmt/core.h>

namespace nusselt::viewer {

/// Prints a line at once: whoever reads it from a file or a pipe sees it while the window is open.
inline void print_line(const std::string& text) {
    fmt::print("{}\n", text);
    std::fflush(stdout);
}

} // namespace nusselt::viewer
