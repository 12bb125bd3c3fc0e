#pragma once
/// Files with commands for the viewer, as docs/viewer.md lists them.

#include "commands.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace nusselt::viewer {

/// Runs commands one after the other, between frames.
class Script {
public:
    /// No commands.
    Script() = default;

    /// \throws std::runtime_error "file:line: message" if it cannot be read or has an unknown command
    explicit Script(const std::filesystem::path& path);

    /// Runs commands up to the next one that waits for frames. To be called before each frame, and after the last.
    /// A command that has nothing to print leaves a message, also on the standard error stream.
    /// \throws std::runtime_error "file:line: message" for a command that fails
    void advance(Viewer& viewer);

private:
    struct Line {
        int number;
        std::vector<std::string> words;
    };

    void run(const Line& line, Viewer& viewer);
    std::string message_of(int line, const std::string& message) const;
    [[noreturn]] void fail(int line, const std::string& message) const;

    std::filesystem::path path_;
    std::vector<Line> lines_;
    std::size_t next_ = 0;
    Playback playback_;
};

} // namespace nusselt::viewer
