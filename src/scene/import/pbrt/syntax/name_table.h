#pragma once
/// Constant tables of names.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

namespace nusselt::scene {

/// The row with this name in a table; null if there is none.
template <class Pointer, std::size_t kSize>
const std::pair<std::string_view, Pointer>*
find_row(const std::pair<std::string_view, Pointer> (&table)[kSize], std::string_view name) {
    const auto* const found = std::find_if(std::begin(table), std::end(table),
                                           [&](const auto& entry) { return entry.first == name; });
    return found == std::end(table) ? nullptr : found;
}

/// The pointer that has this name in a table; null if none has.
template <class Pointer, std::size_t kSize>
Pointer find_named(const std::pair<std::string_view, Pointer> (&table)[kSize], std::string_view name) {
    const auto* const row = find_row(table, name);
    return row == nullptr ? nullptr : row->second;
}

} // namespace nusselt::scene
