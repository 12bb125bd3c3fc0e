#include "lab/parity/parity_check.h"

#include <gtest/gtest.h>

namespace nusselt::parity {

namespace {

/// Errors of each quantity, spread evenly up to `largest`. The default count is that of the full effort for a class
/// of lights.
Errors errors_up_to(double largest, int count = 30'000) {
    Errors errors;
    for (std::size_t q = 0; q < kQuantities; ++q)
        for (int i = 1; i <= count; ++i) errors.add(static_cast<Quantity>(q), largest * i / count);
    return errors;
}

std::vector<std::string> excesses_of(const Errors& device, const Errors& cpp, const Errors& floor) {
    return compare(device, cpp, floor).excesses;
}

TEST(ParityBudget, IsThreeTimesTheErrorOfCpp) {
    EXPECT_TRUE(excesses_of(errors_up_to(2.9e-5), errors_up_to(1e-5), {}).empty());
    const auto found = excesses_of(errors_up_to(3.1e-5), errors_up_to(1e-5), {});
    // Three quantiles of each quantity, and the largest error of two quantities.
    EXPECT_EQ(found.size(), 3 * kQuantities + 2);
}

TEST(ParityBudget, LeavesOutTheLargestErrorOfFewLights) {
    const auto excesses = [](int bad, int count) {
        Errors device = errors_up_to(1e-6, count);
        for (auto& errors : device.of) std::fill(errors.end() - bad, errors.end(), 1.0);
        return excesses_of(device, errors_up_to(1e-6, count), {}).size();
    };
    EXPECT_EQ(excesses(30, 2000), 0u);
    EXPECT_EQ(excesses(32, 2000), kQuantities) << "no 99 % quantile";
    EXPECT_EQ(excesses(32, 60), 2 * kQuantities) << "the tail is the median";
    EXPECT_EQ(excesses(30, 3000), 0u);
    EXPECT_EQ(excesses(32, 3000), 2 * kQuantities) << "for so few errors, the tail is the 99 % quantile";
    EXPECT_EQ(excesses(31, 10'000), kQuantities) << "only the tail";
    EXPECT_EQ(excesses(1, 29'999), 0u);
    EXPECT_EQ(excesses(1, 30'000), 2u) << "the largest error of two quantities";
}

TEST(ParityBudget, TellsOfQuantitiesWithTooFewErrors) {
    const auto of_count = [](int count) {
        return compare(errors_up_to(1, count), errors_up_to(1e-6, count), {});
    };
    EXPECT_TRUE(of_count(59).excesses.empty());
    EXPECT_EQ(of_count(59).vacuous.size(), kQuantities);
    EXPECT_EQ(of_count(59).vacuous.front(), "first random number, too few errors");
    EXPECT_EQ(of_count(60).excesses.size(), 2 * kQuantities);
    EXPECT_TRUE(of_count(60).vacuous.empty());
}

TEST(ParityBudget, IsNotBelowTheFloor) {
    EXPECT_TRUE(excesses_of(errors_up_to(2.9e-5), errors_up_to(1e-7), errors_up_to(1e-5)).empty());
    EXPECT_TRUE(excesses_of(errors_up_to(5e-8), {}, {}).empty()) << "no budget is below a rounding error";
    EXPECT_FALSE(excesses_of(errors_up_to(5e-7), {}, {}).empty());
}

TEST(ParityBudget, JudgesEachQuantityAlone) {
    for (std::size_t q = 0; q < kQuantities; ++q) {
        Errors device = errors_up_to(1e-6);
        for (double& error : device.of[q]) error *= 4;
        const auto found = excesses_of(device, errors_up_to(1e-6), {});
        ASSERT_FALSE(found.empty());
        for (const std::string& line : found) EXPECT_EQ(line.rfind(kQuantityNames[q], 0), 0u) << line;
    }
}

TEST(ParityBudget, CountsDirectionsOffTheLightAndWhatIsNoNumber) {
    for (const auto count : {&Errors::off_the_light, &Errors::no_sample, &Errors::spurious}) {
        Errors device, cpp;
        device.*count = 2;
        cpp.*count = 2;
        EXPECT_TRUE(excesses_of(device, cpp, {}).empty());
        cpp.*count = 1;
        EXPECT_EQ(excesses_of(device, cpp, {}).size(), 1u);
    }
    Errors device, cpp;
    device.invalid = cpp.invalid = 1;
    EXPECT_EQ(excesses_of(device, cpp, {}).size(), 1u) << "even if C++ has them, too";
}

TEST(ParityBudget, LeavesRoomForChanceWhereImagesAreRounded) {
    const auto excesses = [](const Errors& device, const Errors& cpp) {
        return compare(device, cpp, {}, Images::rounded).excesses.size();
    };
    // One bad error of 30 000 is above the 99.99 % quantile, but ten reach below it.
    Errors device = errors_up_to(1e-6);
    for (auto& errors : device.of) errors.back() = 1;
    EXPECT_EQ(excesses(device, errors_up_to(1e-6)), 0u);
    for (auto& errors : device.of) std::fill(errors.end() - 10, errors.end(), 1.0);
    EXPECT_GT(excesses(device, errors_up_to(1e-6)), 0u);

    Errors some, none;
    some.no_sample = 130;
    EXPECT_EQ(excesses(some, none), 1u);
    none.no_sample = 100;
    EXPECT_EQ(excesses(some, none), 0u);
    ++some.no_sample;
    EXPECT_EQ(excesses(some, none), 1u);
}

TEST(ParityBudget, TakesWhatCannotBeToldAsTheLargestError) {
    Errors device = errors_up_to(1e-6);
    device.add(Quantity::first_random, std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(excesses_of(device, errors_up_to(1e-6), {}).size(), 1u);
}

} // namespace

} // namespace nusselt::parity
