#pragma once

#include <fstream>
#include <string>

namespace nusselt_test {

/// A value of /proc/self/status: "VmRSS" for the memory in use, "VmHWM" for the most so far [bytes].
inline double process_memory(const std::string& key) {
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;)
        if (double kilobytes = 0; word == key + ":" && file >> kilobytes) return 1024 * kilobytes;
    return 0;
}

} // namespace nusselt_test
