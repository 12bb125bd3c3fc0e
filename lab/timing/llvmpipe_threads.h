#pragma once

#include "gpu/device.h"

#include <cstdlib>
#include <optional>
#include <string>

namespace nusselt::lab {

/// Mesa's software device runs on as many threads as it is told to: the environment variable LP_NUM_THREADS, empty if it
/// is not set. None for other devices.
inline std::optional<std::string> llvmpipe_threads(const gpu::DeviceDescription& device) {
    if (device.name.find("llvmpipe") == std::string::npos) return std::nullopt;
    const char* threads = std::getenv("LP_NUM_THREADS");
    return threads == nullptr ? "" : threads;
}

} // namespace nusselt::lab
