#pragma once
/// Writes checkpoints while a rendering runs.

#include "image/image.h"
#include "render/frame.h"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace nusselt::app {

/// Stores tiles at regular intervals, in its own thread: those that are finished, and those that an earlier run began.
class Checkpointer {
public:
    /// \param run   see render::save_checkpoint()
    /// \param frame after render::load_checkpoint(), must outlive the object; its finished and begun tiles count as stored
    Checkpointer(std::filesystem::path path, image::Metadata run, const render::Frame& frame,
                 std::chrono::duration<double> interval);
    /// Stores nothing.
    ~Checkpointer();
    Checkpointer(const Checkpointer&) = delete;
    Checkpointer& operator=(const Checkpointer&) = delete;

    /// Any thread may call this, once for each tile that it finishes.
    void add(std::size_t tile);

    /// Ends the thread and stores all finished and begun tiles. The rendering must be over.
    /// \returns what went wrong, or nothing
    [[nodiscard]] std::optional<std::string> save_all();

private:
    /// \param saved number of tiles that the file has
    void save_at_intervals(std::chrono::duration<double> interval, std::size_t saved);
    void stop();

    std::filesystem::path path_;
    image::Metadata run_;
    const render::Frame& frame_;
    render::BegunTiles begun_; ///< of the earlier run; the rendering may change those of the frame
    std::mutex mutex_;         ///< of the following
    std::condition_variable stopped_;
    bool stop_ = false;
    std::vector<std::size_t> finished_;
    std::thread thread_;
};

} // namespace nusselt::app
