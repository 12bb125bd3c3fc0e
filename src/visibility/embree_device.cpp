#include "visibility/embree_device.h"

#include <stdexcept>
#include <string>

namespace nusselt::visibility {

namespace {

[[noreturn]] void throw_embree_error(RTCError code) {
    if (code == RTC_ERROR_OUT_OF_MEMORY)
        throw std::runtime_error("not enough memory for the bounding volume hierarchy of the scene");
    if (code == RTC_ERROR_UNSUPPORTED_CPU)
        throw std::runtime_error("this processor is not supported by Embree");
    throw std::runtime_error("Embree reports error " + std::to_string(code) + " while it builds the scene");
}

} // namespace

Device make_device() {
    Device device(rtcNewDevice(nullptr));
    if (!device) throw_embree_error(rtcGetDeviceError(nullptr));
    return device;
}

void check_for_error(RTCDevice device) {
    if (const RTCError code = rtcGetDeviceError(device); code != RTC_ERROR_NONE) throw_embree_error(code);
}

} // namespace nusselt::visibility
