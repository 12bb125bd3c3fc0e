#include "gpu/error.h"

namespace nusselt::gpu {

std::string size_text(std::uint64_t bytes) {
    const auto in_units = [&](int shift, const char* unit) {
        return std::to_string((bytes + (std::uint64_t{1} << shift) - 1) >> shift) + unit;
    };
    if (bytes >= 1 << 20) return in_units(20, " MiB");
    if (bytes >= 1 << 10) return in_units(10, " KiB");
    return std::to_string(bytes) + " bytes";
}

std::string describe(const std::string& activity, vk::Result result) {
    switch (result) {
    case vk::Result::eErrorOutOfDeviceMemory:
        return activity +
               ": out of memory on the device; close other programs, or use a smaller scene or image";
    case vk::Result::eErrorOutOfHostMemory:
        return activity + ": out of memory; close other programs, or use a smaller scene or image";
    case vk::Result::eErrorDeviceLost:
        return activity + ": the device is lost because its driver crashed or stopped a command that took "
                          "too long; run the program again";
    case vk::Result::eErrorInitializationFailed:
        return activity + ": the driver does not start; install it again";
    default:
        return activity + ": Vulkan reports " + vk::to_string(result) +
               "; update the driver, or choose another device with NUSSELT_DEVICE";
    }
}

void rethrow(const std::string& activity, const vk::SystemError& error) {
    throw Error(describe(activity, static_cast<vk::Result>(error.code().value())));
}

} // namespace nusselt::gpu
