/// Tests of operations across the lanes of a pack against loops over arrays.

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <type_traits>

#include <gtest/gtest.h>

#include <nusselt/simd/across_lanes.h>

namespace nusselt_test {
namespace {

/// \tparam L number of lanes.
template <class L>
class AcrossLanesTest : public ::testing::Test {
protected:
    static constexpr int kLanes = L::value;
    using Pack = nusselt::Pack<float, kLanes>;

    /// Numbers without order, of both signs, whose sums are exact.
    static float number(int i) { return static_cast<float>((7 * i + 3) % 16 - 6); }

    static void expect_lanes(const Pack& pack, const float* expected) {
        float lanes[kLanes];
        pack.store(lanes);
        for (int i = 0; i < kLanes; ++i) EXPECT_EQ(lanes[i], expected[i]) << "lane " << i;
    }

    AcrossLanesTest() {
        for (int i = 0; i < kLanes; ++i) numbers_[i] = number(i);
    }

    float numbers_[kLanes];
    Pack pack_ = nusselt::make_lanes<kLanes>(number);
};

using LaneCounts = ::testing::Types<std::integral_constant<int, 4>, std::integral_constant<int, 8>,
                                    std::integral_constant<int, 16>>;
TYPED_TEST_SUITE(AcrossLanesTest, LaneCounts);

TYPED_TEST(AcrossLanesTest, LanesAreInOrder) { this->expect_lanes(this->pack_, this->numbers_); }

TYPED_TEST(AcrossLanesTest, PermutationsRepeatAndReverse) {
    constexpr int kCount = TypeParam::value;
    std::int32_t reversed[kCount];
    std::int32_t halved[kCount];
    float expected_reversed[kCount];
    float expected_halved[kCount];
    for (int i = 0; i < kCount; ++i) {
        reversed[i] = kCount - 1 - i;
        halved[i] = i / 2;
        expected_reversed[i] = this->numbers_[kCount - 1 - i];
        expected_halved[i] = this->numbers_[i / 2];
    }
    this->expect_lanes(nusselt::permute<kCount>(this->pack_, reversed), expected_reversed);
    this->expect_lanes(nusselt::permute<kCount>(this->pack_, halved), expected_halved);
}

TYPED_TEST(AcrossLanesTest, PermutationsToHalfOfTheLanesTakeAnyOfThem) {
    constexpr int kCount = TypeParam::value;
    if constexpr (kCount > 4) {
        std::int32_t indices[kCount]; // only half of them count
        for (int i = 0; i < kCount; ++i) indices[i] = (3 * i + 1) % kCount;
        float lanes[kCount / 2];
        nusselt::permute<kCount / 2>(this->pack_, indices).store(lanes);
        for (int i = 0; i < kCount / 2; ++i) EXPECT_EQ(lanes[i], this->numbers_[indices[i]]) << "lane " << i;
    }
}

TYPED_TEST(AcrossLanesTest, SumsLeaveOutTheirOwnLane) {
    constexpr int kCount = TypeParam::value;
    float expected[kCount] = {};
    for (int i = 1; i < kCount; ++i) expected[i] = expected[i - 1] + this->numbers_[i - 1];
    this->expect_lanes(nusselt::sums_before(this->pack_), expected);
}

TYPED_TEST(AcrossLanesTest, ExtremesAreThoseOfAllLanes) {
    EXPECT_EQ(nusselt::largest_lane(this->pack_),
              *std::max_element(std::begin(this->numbers_), std::end(this->numbers_)));
    EXPECT_EQ(nusselt::smallest_lane(this->pack_),
              *std::min_element(std::begin(this->numbers_), std::end(this->numbers_)));
    // Wherever they are.
    for (int i = 0; i < TypeParam::value; ++i) {
        const auto marked = [&](float mark) {
            return nusselt::make_lanes<TypeParam::value>([&](int lane) { return lane == i ? mark : 0.0f; });
        };
        EXPECT_EQ(nusselt::largest_lane(marked(5)), 5) << "lane " << i;
        EXPECT_EQ(nusselt::smallest_lane(marked(-5)), -5) << "lane " << i;
    }
}

} // namespace
} // namespace nusselt_test
