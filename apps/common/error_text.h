#pragma once
/// The words for errors, wherever they are caught.

#include "base/words.h"

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

namespace nusselt::app {

inline constexpr const char* kNoMemory =
    "not enough memory; use a smaller scene, a smaller image or fewer layers";

inline bool is_lack_of_memory(const std::exception& error) {
    return dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
}

/// What the error says.
inline std::string error_text(const std::exception& error) {
    return is_lack_of_memory(error) ? kNoMemory : error.what();
}

/// The same if these files were being written. A lack of memory is the only error that does not name them itself.
inline std::string error_text(const std::exception& error, const std::vector<std::filesystem::path>& files) {
    if (!is_lack_of_memory(error)) return error.what();
    std::vector<std::string> names;
    for (const std::filesystem::path& file : files) names.push_back("'" + file.string() + "'");
    return "cannot write " + base::listing(names, "and") + ": " + kNoMemory;
}

} // namespace nusselt::app
