#pragma once
/// Scripts with gaps. Braces mean too much to shells to mark them.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nusselt::app {

/// \param text   with gaps such as @name@
/// \param values for each gap; unknown names stay
inline std::string filled(std::string_view text,
                          const std::vector<std::pair<std::string, std::string>>& values) {
    std::string result;
    while (!text.empty()) {
        const std::pair<std::string, std::string>* found = nullptr;
        if (text.front() == '@')
            for (const auto& value : values)
                if (text.substr(1).starts_with(value.first + "@")) found = &value;
        result += found == nullptr ? std::string(1, text.front()) : found->second;
        text.remove_prefix(found == nullptr ? 1 : found->first.size() + 2);
    }
    return result;
}

} // namespace nusselt::app
