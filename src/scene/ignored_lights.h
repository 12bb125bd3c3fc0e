#pragma once
/// Light sources that are no area lights.

#include "scene/diagnostics.h"

#include <map>
#include <string>

namespace nusselt::scene {

/// Counts them by type, for one warning.
class IgnoredLights {
public:
    void add(const std::string& type, const Location& location);
    /// At the first one, if there are any.
    void warn(Warnings& warnings) const;

private:
    std::map<std::string, int> counts_;
    Location first_;
};

} // namespace nusselt::scene
