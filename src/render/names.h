#pragma once
/// Values of enumerations by the names that users know them by; see settings.h.

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::render {

/// \param values all values of an enumeration that has name_of()
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
    throw std::invalid_argument("unknown setting '" + std::string(name) + "'; there are " + known);
}

} // namespace nusselt::render
