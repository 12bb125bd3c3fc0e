#include "scene/import/ies/ies_numbers.h"

#include <charconv>
#include <cmath>

namespace nusselt::scene {

namespace {

/// Closer angles would drown in rounding errors [degrees].
constexpr double kSmallestStep = 1e-4;

constexpr bool is_separator(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v' || c == ',';
}

std::string ordinal(std::string_view what, std::size_t index, std::size_t count) {
    return std::string(what) + ' ' + std::to_string(index + 1) + " of " + std::to_string(count);
}

} // namespace

bool ends_line(std::string_view text, std::size_t at) {
    const bool is_pair = text[at] == '\r' && at + 1 < text.size() && text[at + 1] == '\n';
    return text[at] == '\n' || (text[at] == '\r' && !is_pair);
}

/// The next word, or nothing at the end.
std::string_view IesNumbers::word() {
    std::size_t begin = 0;
    for (; begin < rest_.size() && is_separator(rest_[begin]); ++begin)
        if (ends_line(rest_, begin)) ++line_;
    std::size_t end = begin;
    while (end < rest_.size() && !is_separator(rest_[end])) ++end;
    const std::string_view result = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    if (!result.empty()) line_of_last_ = line_;
    return result;
}

double IesNumbers::parsed(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_number = error == std::errc{} && end == word.data() + word.size() && std::isfinite(value);
    return is_number ? value : std::nan("");
}

double IesNumbers::number(std::string_view what) {
    return number([&] { return std::string(what); });
}

void IesNumbers::fail_to_parse(std::string_view word, const std::string& what) const {
    if (word.empty()) fail("the file ends before the " + what);
    fail("the " + what + " must be a finite number, found '" + shortened(word) + "'");
}

double IesNumbers::positive(std::string_view what) {
    const double value = number(what);
    if (!(value > 0)) fail("the " + std::string(what) + " must be positive, found " + to_text(value));
    return value;
}

std::size_t IesNumbers::whole(std::string_view what, std::size_t least, std::size_t most) {
    const double value = number(what);
    if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most) &&
          value == std::floor(value)))
        fail("the " + std::string(what) + " must be a whole number from " + std::to_string(least) + " to " +
             std::to_string(most) + ", found " + to_text(value));
    return static_cast<std::size_t>(value);
}

std::vector<double> IesNumbers::list(std::string_view what, std::size_t count) {
    std::vector<double> result;
    result.reserve(count);
    for (std::size_t i = 0; i < count; ++i) result.push_back(number([&] { return ordinal(what, i, count); }));
    return result;
}

std::vector<double> IesNumbers::increasing(std::string_view what, std::size_t count, double least,
                                           double most) {
    std::vector<double> result;
    result.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto name = [&] { return ordinal(what, i, count); };
        const double angle = number(name);
        if (!(angle >= least && angle <= most))
            fail("the " + name() + " must be from " + to_text(least) + " to " + to_text(most) + ", found " +
                 to_text(angle));
        if (i > 0 && !(angle - result.back() >= kSmallestStep))
            fail("the " + name() + " must exceed the one before, " + to_text(result.back()) + ", by " +
                 to_text(kSmallestStep) + " or more, found " + to_text(angle));
        result.push_back(angle);
    }
    return result;
}

void IesNumbers::check_room(std::uint64_t count) const {
    // Each number has a digit and a separator in front.
    const std::uint64_t room = rest_.size() / 2;
    if (count > room)
        fail("the file ends too early: its counts announce " + std::to_string(count) +
             " more numbers, and it has room for " + std::to_string(room));
}

void IesNumbers::expect_end() {
    const std::string_view text = word();
    if (!text.empty()) fail("found '" + shortened(text) + "' behind the last number");
}

void IesNumbers::fail(const std::string& message) const {
    throw SceneError({source_, line_of_last_}, message);
}

} // namespace nusselt::scene
