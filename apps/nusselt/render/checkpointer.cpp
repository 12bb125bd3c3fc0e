#include "checkpointer.h"

#include "apps/common/error_text.h"
#include "apps/common/print_message.h"
#include "render/checkpoint.h"

#include <exception>
#include <utility>

namespace nusselt::app {

Checkpointer::Checkpointer(std::filesystem::path path, image::Metadata run, const render::Frame& frame,
                           std::chrono::duration<double> interval)
    : path_(std::move(path)), run_(std::move(run)), frame_(frame), begun_(*frame.begun) {
    for (std::size_t i = 0; i < frame.tiles.size(); ++i)
        if (frame.is_finished[i] != 0) finished_.push_back(i);
    // The count is taken here because more tiles may be finished when the thread starts.
    thread_ = std::thread([this, interval, saved = finished_.size()] { save_at_intervals(interval, saved); });
}

Checkpointer::~Checkpointer() { stop(); }

void Checkpointer::add(std::size_t tile) {
    const std::lock_guard lock(mutex_);
    finished_.push_back(tile);
}

std::optional<std::string> Checkpointer::save_all() {
    stop();
    try {
        render::save_checkpoint(path_, run_, frame_, finished_, *frame_.begun);
    } catch (const std::exception& error) {
        return error_text(error, {path_});
    }
    return std::nullopt;
}

void Checkpointer::save_at_intervals(std::chrono::duration<double> interval, std::size_t saved) {
    bool failed = false;
    std::unique_lock lock(mutex_);
    while (!stopped_.wait_for(lock, interval, [this] { return stop_; })) {
        if (finished_.size() == saved) continue;
        const std::vector<std::size_t> tiles = finished_;
        lock.unlock();
        try {
            for (const std::size_t tile : tiles) begun_.erase(tile);
            render::save_checkpoint(path_, run_, frame_, tiles, begun_);
            saved = tiles.size();
        } catch (const std::exception& error) {
            // The rendering goes on: the disk may have space for the next checkpoint.
            if (!std::exchange(failed, true)) print_message("\nwarning: {}\n", error_text(error, {path_}));
        }
        lock.lock();
    }
}

void Checkpointer::stop() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    stopped_.notify_all();
    if (thread_.joinable()) thread_.join();
}

} // namespace nusselt::app
