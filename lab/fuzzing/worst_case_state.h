#pragma once
/// Files with the progress of a search for worst cases.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

/// The state from which a search continues.
struct SearchProgress {
    std::uint64_t starts = 0;
    std::vector<long double> parameters; ///< of the worst case; empty if there is none yet
};

struct SearchState {
    std::uint64_t seed = 0;
    std::map<std::string, SearchProgress> targets; ///< by name
};

/// All digits of a number, in hexadecimal.
std::string hexadecimal(long double x);

/// The contents of a state file, or nothing if the file does not exist.
/// \throws std::runtime_error naming the file if it cannot be read or has no such contents
std::optional<SearchState> load_search_state(const std::filesystem::path& path);

/// Replaces the file as a whole. \throws std::runtime_error as base::write_atomically
void save_search_state(const std::filesystem::path& path, const SearchState& state);

} // namespace nusselt::lab
