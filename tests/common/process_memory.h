#pragma once
/// How much memory the process has.

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

/// Whether a sanitizer of g++ or clang adds to memory and time: then limits on both mean nothing.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kHasSanitizer = true;
#elif defined(__has_feature)
inline constexpr bool kHasSanitizer =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer);
#else
inline constexpr bool kHasSanitizer = false;
#endif

} // namespace nusselt_test
