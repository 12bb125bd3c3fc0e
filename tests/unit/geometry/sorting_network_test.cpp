/// Tests of sorting networks by the 0-1 principle: a network that sorts all words of zeros and ones sorts everything.

#include <nusselt/geometry/sorting_network.h>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace nusselt_test {
namespace {

using nusselt::Comparator;
using nusselt::SortingNetwork;

std::vector<std::vector<int>> all_words(int length) {
    std::vector<std::vector<int>> words;
    for (int bits = 0; bits < 1 << length; ++bits) {
        std::vector<int> word;
        for (int i = 0; i < length; ++i) word.push_back(bits >> i & 1);
        words.push_back(word);
    }
    return words;
}

bool sorts_all_words(const std::vector<Comparator>& network, int length) {
    for (std::vector<int> word : all_words(length)) {
        for (const Comparator& c : network) {
            int& low = word[static_cast<std::size_t>(c.low)];
            int& high = word[static_cast<std::size_t>(c.high)];
            if (high < low) std::swap(low, high);
        }
        if (!std::is_sorted(word.begin(), word.end())) return false;
    }
    return true;
}

template <class Size>
class SortingNetworkTest : public ::testing::Test {
protected:
    static constexpr int kLength = Size::value;
    const std::vector<Comparator> network_{std::begin(SortingNetwork<kLength>::kComparators),
                                           std::end(SortingNetwork<kLength>::kComparators)};
};

template <int Length>
using Size = std::integral_constant<int, Length>;
using Sizes = ::testing::Types<Size<3>, Size<4>, Size<5>, Size<6>, Size<7>, Size<8>, Size<9>>;
TYPED_TEST_SUITE(SortingNetworkTest, Sizes);

TYPED_TEST(SortingNetworkTest, SortsAllWords) { EXPECT_TRUE(sorts_all_words(this->network_, this->kLength)); }

TYPED_TEST(SortingNetworkTest, NeedsEveryComparator) {
    for (std::size_t left_out = 0; left_out < this->network_.size(); ++left_out) {
        std::vector<Comparator> mutant = this->network_;
        mutant.erase(mutant.begin() + static_cast<std::ptrdiff_t>(left_out));
        EXPECT_FALSE(sorts_all_words(mutant, this->kLength)) << "without comparator " << left_out;
    }
}

TYPED_TEST(SortingNetworkTest, FailsWithAReversedComparator) {
    std::vector<Comparator> mutant = this->network_;
    std::swap(mutant.back().low, mutant.back().high);
    EXPECT_FALSE(sorts_all_words(mutant, this->kLength));
}

TYPED_TEST(SortingNetworkTest, CallsComparatorsInOrder) {
    std::vector<int> values(static_cast<std::size_t>(this->kLength));
    for (int i = 0; i < this->kLength; ++i) {
        values[static_cast<std::size_t>(i)] = i % 2 == 0 ? i : 2 * this->kLength - i;
    }
    nusselt::sort_by_network<TestFixture::kLength>([&](int low, int high) {
        int& a = values[static_cast<std::size_t>(low)];
        int& b = values[static_cast<std::size_t>(high)];
        if (b < a) std::swap(a, b);
    });
    EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
}

} // namespace
} // namespace nusselt_test
