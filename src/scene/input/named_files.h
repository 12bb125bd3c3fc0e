#pragma once
/// The files that a scene names.

#include "scene/input/diagnostics.h"

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace nusselt::scene {

/// Collects the files while a scene is read, so that its user learns of all missing ones at once.
class NamedFiles {
public:
    /// Notes a file. If it does not exist, reading goes on with something in its place until report_missing().
    /// \param location where the scene names it first
    /// \param kind     of the file, such as "mesh file"
    /// \returns whether it exists
    bool note(const Location& location, std::string_view kind, const std::filesystem::path& path);
    /// The same with a message of its own, for the case that no other file is missing.
    bool note_with_message(const Location& location, std::string message, const std::filesystem::path& path);

    /// Throws a SceneError that names all missing files, if there are any.
    void report_missing() const;

    /// The files that exist, each once.
    const std::set<std::filesystem::path>& existing() const { return existing_; }

private:
    struct Missing {
        Location location;
        std::string message;
        std::filesystem::path path;
    };
    std::vector<Missing> missing_;
    std::unordered_set<std::string> missing_paths_;
    std::set<std::filesystem::path> existing_;
};

} // namespace nusselt::scene
