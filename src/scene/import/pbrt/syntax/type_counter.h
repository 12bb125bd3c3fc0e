#pragma once
/// Counts the unsupported types of a scene.

#include "scene/input/diagnostics.h"

#include <map>
#include <string>

namespace nusselt::scene {

/// Counts directives by type, for one warning.
class TypeCounter {
public:
    void add(const std::string& type, const Location& location);
    /// Warns at the first directive, if there is one, with `sentence` and a list like "2 \"cone\", 1 \"curve\"".
    void warn(const std::string& sentence, Warnings& warnings) const;

private:
    std::map<std::string, std::size_t> counts_;
    Location first_;
};

} // namespace nusselt::scene
