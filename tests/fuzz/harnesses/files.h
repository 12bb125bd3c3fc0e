#pragma once
/// Files made of the bytes of libFuzzer, and what every reader of files promises.

#include "base/temporary_folder.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace nusselt::fuzz {

/// A folder of its own with files.
class Folder : public nusselt::base::TemporaryFolder {
public:
    void write(std::string_view name, std::string_view bytes) const {
        std::ofstream(*this / name, std::ios::binary) << bytes;
    }
};

inline std::string_view text(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// \param problem  empty if there is none
inline void fail_if_any(std::string_view problem) {
    if (problem.empty()) return;
    std::fprintf(stderr, "%.*s\n", static_cast<int>(problem.size()), problem.data());
    std::abort();
}

/// Messages for users have one line, even if names in their files have several.
inline std::string_view problem_of_message(std::string_view message) {
    if (message.empty()) return "a message is empty";
    return message.find('\n') != std::string_view::npos ? "a message has more than one line"
                                                        : std::string_view();
}

/// Calls a reader that may refuse its input with a std::runtime_error of one line; other exceptions end the program.
template <class Reader>
void read_or_refuse(const Reader& reader) {
    try {
        reader();
    } catch (const std::runtime_error& error) {
        const std::string_view problem = problem_of_message(error.what());
        if (!problem.empty()) std::fprintf(stderr, "[%s]\n", error.what());
        fail_if_any(problem);
    }
}

} // namespace nusselt::fuzz
