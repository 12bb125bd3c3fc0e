#pragma once
/// Files that a scene names and that do not exist.

#include "scene/input/diagnostics.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace nusselt::scene {

/// Collects missing files while a scene is read, so that its user learns of all of them at once.
class MissingFiles {
public:
    /// Notes a file if it does not exist. Reading then goes on with something in its place until report().
    /// \param location where the scene names it first
    /// \param kind     of the file, such as "mesh file"
    /// \returns whether it is missing
    bool note(const Location& location, std::string_view kind, const std::filesystem::path& path);
    /// The same with a message of its own, for the case that no other file is missing.
    bool note_with_message(const Location& location, std::string message, const std::filesystem::path& path);

    /// Throws a SceneError that names all missing files, if there are any.
    void report() const;

private:
    struct Entry {
        Location location;
        std::string message;
        std::filesystem::path path;
    };
    std::vector<Entry> entries_;
    std::unordered_set<std::string> paths_;
};

} // namespace nusselt::scene
