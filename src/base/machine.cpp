#include "base/machine.h"
#include "base/words.h"

#include <filesystem>
#include <fstream>
#include <string_view>

namespace nusselt::base {

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
