#include "base/threads.h"

#include <fmt/format.h>

#include <future>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

namespace nusselt::base {

void check_threads(int count) {
    std::promise<void> all_started;
    const std::shared_future<void> end = all_started.get_future().share();
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(count));
    int started = 1;
    try {
        for (; started < count; ++started) threads.emplace_back([end] { end.wait(); });
    } catch (const std::system_error&) {
        // The number tells.
    }
    all_started.set_value();
    for (std::thread& thread : threads) thread.join();
    if (started < count)
        throw std::runtime_error(fmt::format(
            "the system starts only {} of {} threads; take fewer with --threads, or raise its limits of "
            "processes (ulimit -u, pids of a container) or of memory (ulimit -v)",
            started, count));
}

} // namespace nusselt::base
