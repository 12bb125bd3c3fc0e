#pragma once
/// The communication of a rendering with the program.

#include <atomic>
#include <cstddef>
#include <functional>

namespace nusselt::render {

/// All members may be left empty.
struct RenderMonitor {
    /// Called once, when all preparations are made: until then there is nothing that a stop could lose.
    std::function<void()> started;
    /// Called with the share of finished tiles (by pixels) or frames, in (0, 1], from any thread, never by two at once.
    std::function<void(double fraction)> progress;
    /// Called with the number in Frame::tiles of each tile once its pixels are final. As above; its caller waits.
    std::function<void(std::size_t tile)> tile_finished;
    /// Once this is true, the rendering ends within a second, if `started` was called before: preparations go on.
    const std::atomic<bool>* cancel = nullptr;
};

} // namespace nusselt::render
