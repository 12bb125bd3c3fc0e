#include "base/machine.h"

#include <filesystem>
#include <fstream>
#include <string_view>

namespace nusselt::base {

namespace {

/// The argument, in single quotes if a shell would not take it as it is.
std::string shell_word(const std::string& argument) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
    if (!argument.empty() && argument.find_first_not_of(kPlain) == std::string::npos) return argument;
    std::string text = "'";
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

} // namespace

std::string processor_name() {
    constexpr std::string_view kKey = "model name";
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.compare(0, kKey.size(), kKey) == 0) {
            const std::size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
            return begin == std::string::npos ? "" : line.substr(begin);
        }
    return "";
}

std::string command_line() {
    std::ifstream file("/proc/self/cmdline");
    std::string text;
    for (std::string argument; std::getline(file, argument, '\0');)
        text +=
            text.empty() ? std::filesystem::path(argument).filename().string() : " " + shell_word(argument);
    return text;
}

} // namespace nusselt::base
