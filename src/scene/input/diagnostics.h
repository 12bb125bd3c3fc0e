#pragma once
/// Positions in scene files, errors and warnings that name them.

#include "scene/input/file_bytes.h"
#include "scene/input/message.h"

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::scene {

/// A file of a scene. Locations refer to it, also when importers have released its bytes.
struct SourceFile {
    std::filesystem::path path;
    FileBytes bytes;
};

struct Location {
    const SourceFile* file = nullptr; ///< null for what no file says: messages then name no place
    int line = 0; ///< counts from 1; 0 for the file as a whole, where a format has no lines
};

/// "file:line", or "file"
std::string to_string(const Location& location);

/// An error in the user's scene: what() is "file:line: message" or "file: message", one line without control characters,
/// the message cut to 1000 bytes.
class SceneError : public std::runtime_error {
public:
    SceneError(const Location& location, std::string_view message);
};

/// Collects warnings, the first of each kind only, and at most 200 kinds.
class Warnings {
public:
    /// \param kind  warnings of equal kind count as repetitions
    void add(const Location& location, std::string kind, std::string_view message);
    /// The message is its own kind.
    void add(const Location& location, std::string_view message);
    /// Takes over the warnings of `other` in their order.
    void append(const Warnings& other);
    std::vector<std::string> lines() const;

private:
    struct Entry {
        std::string kind;
        std::string line;
    };
    void add_entry(Entry entry);

    std::vector<Entry> entries_; ///< so few that a search takes no longer than a hash
};

} // namespace nusselt::scene
