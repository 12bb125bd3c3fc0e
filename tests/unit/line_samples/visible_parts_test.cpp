/// Tests of the union of what occluders hide: against sorted intervals, in any order, with too little room, and with
/// hostile numbers.

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <nusselt/line_samples/visible_parts.h>
#include <nusselt/simd/pack.h>

#include "proof/hostile/lights.h"

namespace {

using namespace nusselt;
using hostile::RandomSource;
constexpr int kLanes = 8;
using Lines = Pack<float, kLanes>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Occluders of lines from 0 to 1.
std::vector<Interval<Lines>> random_occluders(std::uint64_t index) {
    RandomSource random(3, index);
    std::vector<Interval<Lines>> occluders(static_cast<std::size_t>(1 + random.index(20)));
    for (Interval<Lines>& occluder : occluders)
        for (int i = 0; i < kLanes; ++i) {
            const auto begin = static_cast<float>(random.between(-0.2, 1.2));
            const auto length = static_cast<float>(random.log_between(1e-4, 0.5));
            const bool hides = random.index(3) > 0;
            occluder.begin.set_lane(i, hides ? begin : kInfinity);
            occluder.end.set_lane(i, hides ? begin + length : -kInfinity);
        }
    return occluders;
}

/// The visible length of a line from 0 to 1, by sorting.
double visible_length(const std::vector<Interval<Lines>>& occluders, int lane) {
    std::vector<std::pair<double, double>> sorted;
    for (const Interval<Lines>& o : occluders) sorted.push_back({o.begin.lane(lane), o.end.lane(lane)});
    std::sort(sorted.begin(), sorted.end());
    double visible = 0, dark_until = 0;
    for (const auto& [begin, end] : sorted) {
        if (!(begin < end)) continue;
        visible += std::max(std::min(begin, 1.0) - dark_until, 0.0);
        dark_until = std::max(dark_until, end);
    }
    return visible + std::max(1 - dark_until, 0.0);
}

Lines visible_length(const VisibleParts<Lines>& parts) {
    Lines sum(0.0f);
    for (int k = 0; k < parts.count(); ++k) sum = sum + max(parts[k].end - parts[k].begin, Lines(0.0f));
    return sum;
}

TEST(VisibleParts, AreWhatNoOccluderHidesInAnyOrder) {
    for (std::uint64_t index = 0; index < 2000; ++index) {
        std::vector<Interval<Lines>> occluders = random_occluders(index);
        RandomSource random(4, index);
        for (int pass = 0; pass < 3; ++pass) {
            Interval<Lines> storage[32];
            VisibleParts<Lines> parts(storage, 32);
            parts.reset({Lines(0.0f), Lines(1.0f)});
            for (const Interval<Lines>& occluder : occluders) parts.cut(occluder);
            const Lines length = visible_length(parts);
            const float tolerance = kShortestPart<float> * static_cast<float>(occluders.size() + 1);
            for (int i = 0; i < kLanes; ++i) {
                EXPECT_NEAR(length.lane(i), visible_length(occluders, i), tolerance) << index;
                EXPECT_EQ(parts.lit().lane(i), length.lane(i) > 0) << index;
                EXPECT_EQ(parts.lost().lane(i), 0) << index;
                float begin = kInfinity, end = -kInfinity;
                for (int k = 0; k < parts.count(); ++k) {
                    begin = std::min(begin, parts[k].begin.lane(i));
                    end = std::max(end, parts[k].end.lane(i));
                }
                EXPECT_EQ(parts.bounds().begin.lane(i), begin) << index;
                EXPECT_EQ(parts.bounds().end.lane(i), end) << index;
            }
            for (std::size_t k = occluders.size() - 1; k > 0; --k)
                std::swap(occluders[k],
                          occluders[static_cast<std::size_t>(random.index(static_cast<int>(k) + 1))]);
        }
    }
}

TEST(VisibleParts, TooLittleRoomNeverAddsLight) {
    int lost = 0;
    for (std::uint64_t index = 0; index < 500; ++index) {
        const std::vector<Interval<Lines>> occluders = random_occluders(index);
        for (const int capacity : {1, 2, 3}) {
            Interval<Lines> storage[3];
            VisibleParts<Lines> parts(storage, capacity);
            parts.reset({Lines(0.0f), Lines(1.0f)});
            for (const Interval<Lines>& occluder : occluders) parts.cut(occluder);
            const Lines length = visible_length(parts);
            EXPECT_LE(parts.count(), capacity);
            for (int i = 0; i < kLanes; ++i) {
                const double expected = visible_length(occluders, i);
                EXPECT_LE(length.lane(i), expected + 1e-6) << index;
                if (parts.lost().lane(i) == 0) {
                    EXPECT_NEAR(length.lane(i), expected, 3e-5) << index;
                }
                lost += parts.lost().lane(i) > 0;
            }
        }
    }
    EXPECT_GT(lost, 100);
}

/// If there is no room for all visible parts, the short ones are dropped first, whatever the order of the cuts.
TEST(VisibleParts, TooLittleRoomKeepsTheLongerRemainders) {
    constexpr int kCapacity = 8;
    for (const bool is_reversed : {false, true})
        for (const bool is_descending : {false, true}) {
            Interval<Lines> storage[kCapacity];
            VisibleParts<Lines> parts(storage, kCapacity);
            parts.reset({Lines(0.0f), Lines(1.0f)});
            // Seven large gaps of 0.1 and as many occluders of 0.01. Another occluder cuts each gap close to its end.
            const auto cut = [&](float begin, float end) {
                const Interval<float> hidden =
                    is_reversed ? Interval<float>{1 - end, 1 - begin} : Interval<float>{begin, end};
                parts.cut({Lines(hidden.begin), Lines(hidden.end)});
            };
            const auto cut_all = [&](float begin, float length) {
                for (int k = 0; k < 7; ++k) {
                    const float at = static_cast<float>(is_descending ? 6 - k : k) * 0.11f + begin;
                    cut(at, at + length);
                }
            };
            cut_all(0.1f, 0.01f);
            EXPECT_EQ(parts.count(), kCapacity);
            EXPECT_EQ(parts.lost().lane(0), 0);
            cut_all(0.09f, 0.005f);
            EXPECT_EQ(parts.lost().lane(3), 7);
            for (int i = 0; i < kLanes; ++i)
                EXPECT_NEAR(visible_length(parts).lane(i), 1 - 7 * (0.01f + 0.005f + 0.005f), 1e-5f);
            cut_all(0.005f, 0.005f);
            EXPECT_EQ(parts.lost().lane(3), 14);
            for (int i = 0; i < kLanes; ++i)
                EXPECT_NEAR(visible_length(parts).lane(i), 1 - 7 * 0.02f - 7 * 0.01f, 1e-5f);
        }
}

TEST(VisibleParts, SlotsOfHiddenLinesAreFree) {
    Interval<float> storage[4];
    VisibleParts<float> parts(storage, 4);
    parts.reset({0, 1});
    parts.cut({0.2f, 0.3f});
    parts.cut({0.6f, 0.7f});
    EXPECT_EQ(parts.count(), 3);
    parts.cut({-kInfinity, kInfinity});
    EXPECT_EQ(parts.count(), 0);
    EXPECT_FALSE(parts.lit());
    parts.cut({0.4f, 0.5f});
    EXPECT_FALSE(parts.lit());
}

TEST(VisibleParts, GapsOfRoundingAreDark) {
    Interval<float> storage[4];
    VisibleParts<float> parts(storage, 4);
    parts.reset({2, 4});
    parts.cut({0, 3});
    parts.cut({3.000001f, 5});
    EXPECT_FALSE(parts.lit());
    parts.reset({2, 4});
    parts.cut({0, 3});
    parts.cut({3.00001f, 5});
    EXPECT_TRUE(parts.lit());
}

TEST(VisibleParts, IntervalsThatHideNothing) {
    for (const Interval<float> nothing : {Interval<float>{kNaN, kNaN},
                                          {kNaN, 1},
                                          {0, kNaN},
                                          {0.7f, 0.3f},
                                          {0.5f, 0.5f},
                                          empty_interval<float>(),
                                          {-2, 0},
                                          {1, 2},
                                          {kInfinity, kInfinity}}) {
        Interval<float> storage[2];
        VisibleParts<float> parts(storage, 2);
        parts.reset({0, 1});
        parts.cut(nothing);
        ASSERT_EQ(parts.count(), 1);
        EXPECT_EQ(parts[0].begin, 0);
        EXPECT_EQ(parts[0].end, 1);
    }
}

TEST(VisibleParts, LinesWithoutLengthAreDark) {
    for (const Interval<float> whole :
         {Interval<float>{1, 1}, {2, 1}, {kNaN, 1}, {0, kNaN}, {kNaN, kNaN}, {kInfinity, kInfinity}}) {
        Interval<float> storage[2];
        VisibleParts<float> parts(storage, 2);
        parts.reset(whole);
        EXPECT_FALSE(parts.lit());
        parts.cut({0, 1});
        EXPECT_FALSE(parts.lit());
    }
}

TEST(AboveHorizon, KeepsWhatFacesTheSurface) {
    const Vec3<float> normal{0, 0, 1};
    const Interval<float> whole{2, 4};
    const auto part = [&](float begin, float end) {
        return part_above_horizon<float>({1, 0, begin}, {3, 0, end}, normal, whole);
    };
    EXPECT_EQ(part(1, 3).begin, 2);
    EXPECT_EQ(part(1, 3).end, 4);
    EXPECT_EQ(part(0, 0).begin, 2);
    EXPECT_EQ(part(0, 0).end, 4);
    EXPECT_FLOAT_EQ(part(-1, 3).begin, 2.5f);
    EXPECT_EQ(part(-1, 3).end, 4);
    EXPECT_EQ(part(1, -3).begin, 2);
    EXPECT_FLOAT_EQ(part(1, -3).end, 2.5f);
    EXPECT_FALSE(part(-1, -3).begin < part(-1, -3).end);
    EXPECT_FALSE(part(-1, 0).begin < part(-1, 0).end);
}

} // namespace
