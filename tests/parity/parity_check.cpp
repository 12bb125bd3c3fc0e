#include "parity_check.h"

#include <fmt/core.h>

#include <algorithm>

namespace nusselt::parity {

namespace {

/// Budgets of the issue that the twins were written for: relative to C++, never fitted to what a device does.
constexpr double kFactor = 3;

/// What a result in float differs from the exact one by, at least: half the spacing of floats below one.
constexpr double kRounding = std::numeric_limits<float>::epsilon() / 4;

constexpr std::pair<const char*, double> kShares[] = {
    {"median", 0.5}, {"99 %", 0.99}, {"99.9 %", 0.999}, {"largest", 1}};

/// The largest of the other errors is that of a single light where a quantity is hard to tell (say, the second random
/// number at the tip of a sector): that of one method may be three times that of another by chance alone.
bool has_bounded_maximum(Quantity quantity) {
    return quantity == Quantity::first_random || quantity == Quantity::measure;
}

double quantile(const std::vector<double>& sorted, double share) {
    if (sorted.empty()) return 0;
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

void sort(Errors& errors) {
    for (auto& values : errors.of) {
        // What cannot be told counts as the largest error, as in the accuracy tables.
        for (double& value : values)
            if (!(value <= 1)) value = 1;
        std::sort(values.begin(), values.end());
    }
}

} // namespace

void Errors::append(const Errors& other) {
    for (std::size_t i = 0; i < kQuantities; ++i)
        of[i].insert(of[i].end(), other.of[i].begin(), other.of[i].end());
    off_the_light += other.off_the_light;
    no_sample += other.no_sample;
    spurious += other.spurious;
    invalid += other.invalid;
}

void Verdict::add(const std::string& lights, const Verdict& other) {
    for (const std::string& excess : other.excesses) excesses.push_back(lights + ": " + excess);
    if (other.largest_ratio <= largest_ratio) return;
    largest_ratio = other.largest_ratio;
    where = lights + ": " + other.where;
}

Verdict compare(Errors device, Errors cpp, Errors floor) {
    Verdict verdict;
    sort(device);
    sort(cpp);
    sort(floor);
    for (std::size_t i = 0; i < kQuantities; ++i)
        for (const auto& [name, share] : kShares) {
            if (share == 1 && !has_bounded_maximum(static_cast<Quantity>(i))) continue;
            const double value = quantile(device.of[i], share);
            const double reference = quantile(cpp.of[i], share);
            const double least = quantile(floor.of[i], share);
            const double ratio = value / std::max({reference, least, kRounding});
            const std::string where = fmt::format("{}, {}", kQuantityNames[i], name);
            if (ratio > verdict.largest_ratio) {
                verdict.largest_ratio = ratio;
                verdict.where = where;
            }
            if (!(ratio <= kFactor))
                verdict.excesses.push_back(
                    fmt::format("{}: {:.3g}, {:.3g} times that of C++, {:.3g} (floor {:.3g})", where, value,
                                ratio, reference, least));
        }
    const auto count = [&](const char* name, std::int64_t value, std::int64_t limit) {
        if (value > limit) verdict.excesses.push_back(fmt::format("{}: {}, in C++ {}", name, value, limit));
    };
    count("off the light", device.off_the_light, cpp.off_the_light);
    count("without a sample", device.no_sample, cpp.no_sample);
    count("dark, but with a sample or measure", device.spurious, cpp.spurious);
    count("NaN, infinite or negative", device.invalid, 0);
    return verdict;
}

} // namespace nusselt::parity
