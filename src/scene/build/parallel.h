#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <tbb/parallel_for.h>

namespace nusselt::scene {

/// Calls `body(i)` for each i below `count` in parallel. If calls throw, rethrows what the one with the smallest i threw,
/// so that a scene with several mistakes gives the same message each time. Calls with a larger i than one that threw may be
/// left out.
template <class Body>
void parallel_for_each_index(std::size_t count, const Body& body) {
    std::mutex mutex;
    std::exception_ptr error;
    std::atomic<std::size_t> first_failure{count};
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        if (i > first_failure) return;
        try {
            body(i);
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (i > first_failure) return;
            first_failure = i;
            error = std::current_exception();
        }
    });
    if (error != nullptr) std::rethrow_exception(error);
}

} // namespace nusselt::scene
