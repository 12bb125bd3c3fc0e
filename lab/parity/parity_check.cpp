#include "lab/parity/parity_check.h"

#include "proof/quantile.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace nusselt::parity {

namespace {

/// This factor is a rule of the project. It was not fitted to the results of a device.
constexpr double kFactor = 3;

/// The tail is the quantile with this many errors above it, but at most 99.9 %. With fewer errors above it, the
/// quantile would depend on chance.
constexpr double kErrorsBeyondTail = 30;

/// The far tail and the largest error depend on few errors. They are compared only for at least as many errors as the
/// full effort has for a class of lights.
constexpr std::size_t kErrorsForExtremes = 30'000;

/// The smallest error that can be asked of a float: half the spacing of floats below one.
constexpr double kRounding = std::numeric_limits<float>::epsilon() / 4;

/// Names and shares of the quantiles that are compared. None has fewer errors above it than the tail.
std::vector<std::pair<const char*, double>> quantiles_of(std::size_t errors, Tail tail) {
    const double largest_share = 1 - kErrorsBeyondTail / static_cast<double>(errors);
    std::vector<std::pair<const char*, double>> shares;
    if (largest_share < 0.5) return shares;
    shares.emplace_back("median", 0.5);
    if (largest_share >= 0.99) shares.emplace_back("99 %", 0.99);
    shares.emplace_back("tail", std::min(largest_share, 0.999));
    if (errors >= kErrorsForExtremes) {
        if (tail == Tail::nearly_largest) shares.emplace_back("far tail", 0.9999);
        if (tail == Tail::largest) shares.emplace_back("largest", 1);
    }
    return shares;
}

void sort(std::vector<double>& errors) {
    for (double& error : errors)
        if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
    std::sort(errors.begin(), errors.end());
}

Budget budget_of(Quantity quantity) {
    switch (quantity) {
    case Quantity::first_random:
        return {Tail::largest, 1};
    case Quantity::measure:
        return {Tail::largest};
    case Quantity::second_random:
    case Quantity::aim:
    case Quantity::first_inverse:
    case Quantity::second_inverse:
        return {Tail::quantiles, 1};
    default:
        return {};
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

std::string Compared::where() const {
    return (lights.empty() ? "" : lights + ": ") + quantity + ", " + quantile;
}

void Verdict::add(const std::string& lights_of_other, const Verdict& other) {
    const std::string prefix = lights_of_other.empty() ? "" : lights_of_other + ": ";
    lights += other.lights;
    for (Compared row : other.compared) {
        row.lights = lights_of_other;
        compared.push_back(std::move(row));
    }
    for (const std::string& excess : other.excesses) excesses.push_back(prefix + excess);
    for (const std::string& name : other.vacuous) vacuous.push_back(prefix + name);
    if (other.largest_ratio <= largest_ratio) return;
    largest_ratio = other.largest_ratio;
    where = prefix + other.where;
}

Verdict compare(const std::string& quantity, std::vector<double> device, std::vector<double> cpp,
                std::vector<double> floor, const Budget& budget) {
    sort(device);
    sort(cpp);
    sort(floor);
    const auto shares = quantiles_of(device.size(), budget.tail);
    Verdict verdict;
    if (shares.empty() && !device.empty()) verdict.vacuous.push_back(quantity + ", too few errors");
    for (const auto& [name, share] : shares) {
        const double value = proof::quantile_of_sorted(device, share);
        const double reference = proof::quantile_of_sorted(cpp, share);
        const double least = proof::quantile_of_sorted(floor, share);
        const double unit = std::max({reference, least, kRounding});
        const double ratio = value / unit;
        Compared row{.quantity = quantity, .quantile = name, .device = value, .cpp = reference};
        const std::string where = row.where();
        if (!(kFactor * unit < budget.bound)) {
            verdict.vacuous.push_back(where);
            continue;
        }
        verdict.compared.push_back(std::move(row));
        if (ratio > verdict.largest_ratio) {
            verdict.largest_ratio = ratio;
            verdict.where = where;
        }
        if (!(ratio <= kFactor))
            verdict.excesses.push_back(
                fmt::format("{} ({:.4g} %): {:.3g}, {:.3g} times that of C++, {:.3g} (floor {:.3g})", where,
                            100 * share, value, ratio, reference, least));
    }
    return verdict;
}

Verdict compare(const Errors& device, const Errors& cpp, const Errors& floor, Images images) {
    Verdict verdict;
    for (std::size_t i = 0; i < kQuantities; ++i) {
        Budget budget = budget_of(static_cast<Quantity>(i));
        if (images == Images::rounded && budget.tail == Tail::largest) budget.tail = Tail::nearly_largest;
        verdict.add("", compare(kQuantityNames[i], device.of[i], cpp.of[i], floor.of[i], budget));
    }
    const auto count = [&](const char* name, std::int64_t value, std::int64_t in_cpp) {
        const double chance = images == Images::rounded ? 3 * std::sqrt(static_cast<double>(in_cpp)) : 0;
        if (static_cast<double>(value - in_cpp) > chance)
            verdict.excesses.push_back(fmt::format("{}: {}, in C++ {}", name, value, in_cpp));
    };
    count("off the light", device.off_the_light, cpp.off_the_light);
    count("without a sample", device.no_sample, cpp.no_sample);
    count("dark, but with a sample or measure", device.spurious, cpp.spurious);
    count("NaN, infinite or negative", device.invalid, 0);
    return verdict;
}

} // namespace nusselt::parity
