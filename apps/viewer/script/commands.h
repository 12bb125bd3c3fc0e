#pragma once
/// The commands of scripts, as docs/viewer.md lists them.

#include "viewer/viewer.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nusselt::viewer {

/// Frames that were timed.
struct TimedFrames {
    long count;
    double seconds;   ///< that all of them took
    PictureSize size; ///< of the last one
};

/// What a script waits for, and what goes on meanwhile.
struct Playback {
    using Clock = std::chrono::steady_clock;

    /// Waits for frames and times them.
    void begin(long frames);
    /// To be called after each finished frame.
    void note_frame(const Session& session);

    long frames_left = 0;
    long count = 0; ///< of the frames that are being timed; 0 for none
    Clock::time_point begin_time = {};
    std::optional<TimedFrames> timed; ///< by the last command `frames`
    // By how much the camera turns before each frame [rad].
    double turning_right = 0, turning_up = 0;
};

/// There is nothing to print: a mistake after which a script goes on.
struct NothingToPrint : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The words after the command.
using Arguments = std::vector<std::string>;

/// The number of arguments of a command, and its action.
struct Command {
    std::size_t arguments;
    /// \throws std::exception if it fails; see also NothingToPrint
    std::function<void(Viewer&, Playback&, const Arguments&)> run;
};

/// All commands by their names.
const std::map<std::string, Command>& commands();

} // namespace nusselt::viewer
