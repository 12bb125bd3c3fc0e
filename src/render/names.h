#pragma once
/// Enumerations whose values users know by names; see settings.h.

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::render {

/// A row of the table behind an enumeration.
template <class Value>
struct Named {
    Value value;
    std::string_view name;
};

/// The table behind an enumeration: specialised for each one that has names.
template <class Value>
inline constexpr std::array<Named<Value>, 0> kNames = {};

template <class Value>
concept HasNames = !kNames<Value>.empty();

/// The values of a table, in its order.
template <class Value, std::size_t kCount>
constexpr std::array<Value, kCount> values_of(const std::array<Named<Value>, kCount>& table) {
    std::array<Value, kCount> values{};
    for (std::size_t i = 0; i < kCount; ++i) values[i] = table[i].value;
    return values;
}

/// \returns nothing for numbers that are no value of the enumeration
template <HasNames Value>
constexpr std::string_view name_of(Value value) {
    for (const Named<Value>& row : kNames<Value>)
        if (row.value == value) return row.name;
    return {};
}

/// \param values of an enumeration that has name_of()
template <class Values>
std::vector<std::string> names_of(const Values& values) {
    std::vector<std::string> names;
    for (const auto value : values) names.emplace_back(name_of(value));
    return names;
}

/// The value of that name. \throws std::invalid_argument with all names if there is none
template <class Values>
auto from_name(const Values& values, std::string_view name) {
    for (const auto value : values)
        if (name_of(value) == name) return value;
    std::string known;
    for (const std::string& other : names_of(values)) known += (known.empty() ? "" : ", ") + other;
    throw std::invalid_argument("unknown setting '" + std::string(name) + "'; use one of " + known);
}

} // namespace nusselt::render
