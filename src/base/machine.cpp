#include "base/machine.h"
#include "base/words.h"

#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

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
    std::vector<std::string> arguments;
    for (std::string argument; std::getline(file, argument, '\0');) arguments.push_back(argument);
    return command_line_of(arguments);
}

std::string command_line_of(const std::vector<std::string>& arguments) {
    auto at = arguments.begin();
    const auto name = [&] { return std::filesystem::path(*at).filename().string(); };
    // A program with libraries of its own is an argument of the loader, after the loader's options.
    if (at != arguments.end() && name().rfind("ld-linux", 0) == 0) {
        ++at;
        while (at != arguments.end() && at->rfind("--", 0) == 0) {
            const bool has_value = *at != "--inhibit-cache";
            ++at;
            if (has_value && at != arguments.end()) ++at;
        }
    }
    if (at == arguments.end()) return "";
    std::string text = name();
    while (++at != arguments.end()) text += " " + shell_word(*at);
    return text;
}

} // namespace nusselt::base
