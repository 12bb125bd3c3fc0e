#include "viewer/frame_pace.h"

#include <gtest/gtest.h>

namespace nusselt::viewer {
namespace {

TEST(FramePace, RendersAllPixelsAtRest) {
    FramePace pace;
    EXPECT_EQ(pace.reduction(false), 1);
    pace.note(1, 100);
    EXPECT_EQ(pace.reduction(false), 1);
}

TEST(FramePace, BeginsWithFewPixelsAndTakesMoreIfThereIsTime) {
    FramePace pace;
    EXPECT_EQ(pace.reduction(true), FramePace::kLargestReduction);
    pace.note(8, 0.001);
    EXPECT_EQ(pace.reduction(true), 1);
}

TEST(FramePace, TakesTheFinestResolutionThatIsInTime) {
    FramePace pace;
    for (const auto& [seconds, reduction] : {std::pair{0.09, 1}, {0.3, 2}, {1.5, 4}, {5.0, 8}, {1000.0, 8}}) {
        pace.note(1, seconds);
        EXPECT_EQ(pace.reduction(true), reduction) << seconds;
    }
}

TEST(FramePace, DoesNotAlternate) {
    // Each frame takes 0.02 s, and its pixels take 0.9 s if it has all of them.
    const auto seconds = [](int reduction) { return 0.02 + 0.9 / (reduction * reduction); };
    FramePace pace;
    for (int i = 0; i < 4; ++i) pace.note(pace.reduction(true), seconds(pace.reduction(true)));
    const int reduction = pace.reduction(true);
    EXPECT_LE(seconds(reduction), FramePace::kTarget);
    for (int i = 0; i < 4; ++i) {
        pace.note(reduction, seconds(reduction));
        EXPECT_EQ(pace.reduction(true), reduction);
    }
}

} // namespace
} // namespace nusselt::viewer
