#pragma once
/// Checkpoints while a rendering runs.

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

/// Stores finished tiles every now and then, in a thread of its own.
class Checkpointer {
public:
    /// \param run   see render::save_checkpoint()
    /// \param frame must outlive the object; finished tiles count as stored
    Checkpointer(std::filesystem::path path, image::Metadata run, const render::Frame& frame,
                 std::chrono::duration<double> interval);
    /// Stores nothing.
    ~Checkpointer();
    Checkpointer(const Checkpointer&) = delete;
    Checkpointer& operator=(const Checkpointer&) = delete;

    /// To be called for each tile that is finished from now on, by any thread.
    void add(std::size_t tile);

    /// Ends the thread and stores all that is finished.
    /// \returns what went wrong, or nothing
    [[nodiscard]] std::optional<std::string> save_all();

private:
    /// \param saved number of tiles that the file has
    void save_at_intervals(std::chrono::duration<double> interval, std::size_t saved);
    void stop();

    std::filesystem::path path_;
    image::Metadata run_;
    const render::Frame& frame_;
    std::mutex mutex_; ///< of the following
    std::condition_variable stopped_;
    bool stop_ = false;
    std::vector<std::size_t> finished_;
    std::thread thread_;
};

} // namespace nusselt::app
