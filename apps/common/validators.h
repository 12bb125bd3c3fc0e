#pragma once
/// What options let through. Descriptions are what HelpFormatter shows. CLI11 converts texts in its own way: it reads "010"
/// as 8 and lets NaN pass.

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::app {

/// The number that the whole text spells, if it does.
template <class Number>
std::optional<Number> parsed(const std::string& text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    return is_number ? std::optional(value) : std::nullopt;
}

/// Replaces a whole number from low to high, perhaps in the form of "1e3", by its digits. For Option::transform().
CLI::Validator to_whole_number(std::uint64_t low, std::uint64_t high);

/// The begin of the description of to_one_of().
inline constexpr const char* kOneOf = "one of ";

/// Replaces a name, with hyphens or underscores, by the one of this list. For Option::transform().
CLI::Validator to_one_of(const std::vector<std::string>& names);

/// Numbers from low to high.
CLI::Validator number(double low, double high);

/// Numbers above 0, up to a limit, without NaN and infinities.
CLI::Validator number_above_zero(double high);

/// The seconds of a time budget, positive and finite.
CLI::Validator seconds();

/// Stops of exposure.
CLI::Validator exposure();

} // namespace nusselt::app
