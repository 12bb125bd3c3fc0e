// Loops that run in parallel, as building scenes needs them.

#include "scene/build/parallel.h"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace nusselt::scene {
namespace {

TEST(Parallel, CallsTheBodyOncePerIndex) {
    std::vector<int> calls(1000);
    parallel_for_each_index(calls.size(), [&](std::size_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(1000, 1));
    parallel_for_each_index(0, [](std::size_t) { FAIL(); });
}

TEST(Parallel, ReportsTheFailureWithTheSmallestIndex) {
    constexpr std::size_t kFirstFailure = 2;
    for (int trial = 0; trial < 50; ++trial) {
        std::atomic<int> failures = 0;
        try {
            parallel_for_each_index(64, [&](std::size_t i) {
                if (i < kFirstFailure) return;
                // The first failure comes last if there is a second thread.
                if (i == kFirstFailure) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                ++failures;
                throw std::runtime_error(std::to_string(i));
            });
            FAIL() << "no failure is reported";
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(error.what(), std::to_string(kFirstFailure)) << "of " << failures << " failures";
        }
    }
}

} // namespace
} // namespace nusselt::scene
