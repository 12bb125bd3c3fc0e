#include "base/memory_text.h"

#include <cmath>
#include <cstdint>

namespace nusselt::base {

std::string memory_text(double bytes) {
    constexpr double kGigabyte = 1e9;
    constexpr double kMegabyte = 1e6;
    if (bytes < kGigabyte)
        return std::to_string(static_cast<std::uint64_t>(std::ceil(bytes / kMegabyte))) + " MB";
    const auto tenths = static_cast<std::uint64_t>(bytes / kGigabyte * 10 + 0.5);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " GB";
}

} // namespace nusselt::base
