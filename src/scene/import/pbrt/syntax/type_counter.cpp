#include "scene/import/pbrt/syntax/type_counter.h"

namespace nusselt::scene {

void TypeCounter::add(const std::string& type, const Location& location) {
    if (counts_.empty()) first_ = location;
    ++counts_[type];
}

void TypeCounter::warn(const std::string& sentence, Warnings& warnings) const {
    if (counts_.empty()) return;
    constexpr std::size_t kShownTypes = 8;
    constexpr std::size_t kShownBytes = 40;
    std::size_t shown = 0;
    std::string list;
    for (const auto& [type, count] : counts_) {
        if (++shown > kShownTypes) continue;
        list +=
            (list.empty() ? "" : ", ") + std::to_string(count) + " \"" + shortened(type, kShownBytes) + '"';
    }
    if (shown > kShownTypes) list += ", ...";
    warnings.add(first_, sentence + ": " + list);
}

} // namespace nusselt::scene
