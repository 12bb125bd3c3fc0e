#pragma once

#include "gpu/device.h"

#include <cstdlib>
#include <optional>
#include <string>

namespace nusselt::lab {

/// The number of threads of Mesa's software device, from the environment variable LP_NUM_THREADS. Empty if it is not
/// set; none for other devices.
inline std::optional<std::string> llvmpipe_threads(const gpu::DeviceDescription& device) {
    if (device.name.find("llvmpipe") == std::string::npos) return std::nullopt;
    const char* threads = std::getenv("LP_NUM_THREADS");
    return threads == nullptr ? "" : threads;
}

} // namespace nusselt::lab
