#pragma once

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

namespace nusselt::app {

/// The number that the whole text spells, if it does.
template <class Number>
std::optional<Number> parsed(const std::string& text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    return is_number ? std::optional(value) : std::nullopt;
}

/// Decimal integers from low to high. CLI11 alone lets negative and too large numbers wrap around.
inline CLI::Validator whole_number(std::uint64_t low, std::uint64_t high) {
    const auto check = [low, high](const std::string& text) -> std::string {
        const auto value = parsed<std::uint64_t>(text);
        if (value && *value >= low && *value <= high) return {};
        return fmt::format("'{}' must be a whole number from {} to {}", text, low, high);
    };
    return CLI::Validator(check, fmt::format("in [{}, {}]", low, high), "whole number");
}

/// Numbers from low to high. CLI11 alone lets NaN pass.
inline CLI::Validator number(double low, double high) {
    const auto check = [low, high](const std::string& text) -> std::string {
        const auto value = parsed<double>(text);
        if (value && *value >= low && *value <= high) return {};
        return fmt::format("'{}' must be a number from {} to {}", text, low, high);
    };
    return CLI::Validator(check, fmt::format("in [{}, {}]", low, high), "number");
}

/// The seconds of a time budget, positive and finite.
inline CLI::Validator seconds() {
    const auto check = [](const std::string& text) -> std::string {
        const auto value = parsed<double>(text);
        if (value && *value > 0 && *value <= 1e9) return {};
        return fmt::format("'{}' must be a number of seconds above 0, at most 1e9", text);
    };
    return CLI::Validator(check, "above 0", "seconds");
}

/// Numbers above 0, up to a limit, without NaN and infinities.
inline CLI::Validator number_above_zero(double high) {
    const auto check = [high](const std::string& text) -> std::string {
        const auto value = parsed<double>(text);
        if (value && *value > 0 && *value <= high) return {};
        return fmt::format("'{}' must be a number above 0, at most {:g}", text, high);
    };
    return CLI::Validator(check, fmt::format("in (0, {:g}]", high), "number above 0");
}

/// Stops of exposure.
inline CLI::Validator exposure() {
    const auto check = [](const std::string& text) -> std::string {
        const auto value = parsed<double>(text);
        if (value && std::abs(*value) <= 64) return {};
        return fmt::format("'{}' must be a number of stops from -64 to 64", text);
    };
    return CLI::Validator(check, "in [-64, 64]", "exposure");
}

} // namespace nusselt::app
