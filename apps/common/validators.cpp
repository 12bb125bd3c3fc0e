#include "validators.h"

#include "base/words.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>

namespace nusselt::app {

namespace {

/// Up to here, doubles have all whole numbers.
constexpr double kLargestExactDouble = 9007199254740992;

std::optional<std::uint64_t> parsed_whole_number(const std::string& text) {
    if (const auto digits = parsed<std::uint64_t>(text)) return digits;
    const auto value = parsed<double>(text);
    if (!value || !(*value >= 0 && *value <= kLargestExactDouble) || *value != std::floor(*value)) return {};
    return static_cast<std::uint64_t>(*value);
}

std::string text_of(std::uint64_t bound) {
    if (bound == std::numeric_limits<std::uint64_t>::max()) return "2^64 - 1";
    if (bound == std::numeric_limits<std::uint32_t>::max()) return "2^32 - 1";
    return std::to_string(bound);
}

std::string with_underscores(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

/// \param description  of the values, for the help
/// \param expected     the same, for messages
/// \param lets_through whether a value is allowed
CLI::Validator numbers(const std::string& description, const std::string& expected,
                       const std::function<bool(double)>& lets_through) {
    const auto check = [expected, lets_through](const std::string& text) -> std::string {
        const auto value = parsed<double>(text);
        if (value && lets_through(*value)) return {};
        return fmt::format("'{}' must be {}", text, expected);
    };
    return CLI::Validator(check, description);
}

} // namespace

CLI::Validator to_whole_number(std::uint64_t low, std::uint64_t high) {
    const auto convert = [low, high](std::string& text) -> std::string {
        const auto value = parsed_whole_number(text);
        if (!value || *value < low || *value > high)
            return fmt::format("'{}' must be a whole number from {} to {}", text, text_of(low),
                               text_of(high));
        text = std::to_string(*value);
        return {};
    };
    return CLI::Validator(convert, fmt::format("{} to {}", text_of(low), text_of(high)));
}

CLI::Validator to_one_of(const std::vector<std::string>& names) {
    const auto convert = [names](std::string& text) -> std::string {
        for (const std::string& name : names)
            if (with_underscores(name) == with_underscores(text)) {
                text = name;
                return {};
            }
        if (const auto meant = base::likely_meant(text, names))
            return fmt::format("unknown name '{}' (did you mean '{}'?)", text, *meant);
        return fmt::format("'{}' must be one of {}", text, fmt::join(names, ", "));
    };
    return CLI::Validator(convert, fmt::format("{}{}", kOneOf, fmt::join(names, ", ")));
}

CLI::Validator number(double low, double high) {
    return numbers(fmt::format("{} to {}", low, high), fmt::format("a number from {} to {}", low, high),
                   [low, high](double value) { return value >= low && value <= high; });
}

CLI::Validator number_above_zero(double high) {
    const std::string range =
        high < std::numeric_limits<double>::max() ? fmt::format("above 0, at most {}", high) : "above 0";
    return numbers(range, "a number " + range, [high](double value) { return value > 0 && value <= high; });
}

CLI::Validator seconds() {
    return numbers("above 0, at most 1e9", "a number of seconds above 0, at most 1e9",
                   [](double value) { return value > 0 && value <= 1e9; });
}

CLI::Validator exposure() {
    return numbers("-64 to 64", "a number of stops from -64 to 64",
                   [](double value) { return std::abs(value) <= 64; });
}

} // namespace nusselt::app
