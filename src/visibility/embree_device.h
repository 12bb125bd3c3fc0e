#pragma once
/// Embree's device and its errors. Only for code that calls Embree itself.

#include "visibility/embree_api.h"

#include <memory>

namespace nusselt::visibility {

struct DeviceDeleter {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
using Device = std::unique_ptr<RTCDeviceTy, DeviceDeleter>;

/// \throws std::runtime_error if Embree does not work here
Device make_device();

/// \throws std::runtime_error if Embree met an error since the last call
void check_for_error(RTCDevice device);

} // namespace nusselt::visibility
