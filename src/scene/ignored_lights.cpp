#include "scene/ignored_lights.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace nusselt::scene {

void IgnoredLights::add(const std::string& type, const Location& location) {
    static constexpr std::string_view kTypes[] = {"infinite",    "distant",    "point",     "spot",
                                                  "goniometric", "projection", "exinfinite"};
    if (counts_.empty()) first_ = location;
    const bool is_known = std::find(std::begin(kTypes), std::end(kTypes), type) != std::end(kTypes);
    ++counts_[is_known ? type : "of unknown type"];
}

void IgnoredLights::warn(Warnings& warnings) const {
    if (counts_.empty()) return;
    int total = 0;
    std::string list;
    for (const auto& [type, count] : counts_) {
        total += count;
        list += (list.empty() ? "" : ", ") + std::to_string(count) + ' ' + type;
    }
    warnings.add(first_, std::to_string(total) + (total == 1 ? " light source is" : " light sources are") +
                             " ignored (" + list + "): only area lights are rendered");
}

} // namespace nusselt::scene
