#include "gpu/error.h"

namespace nusselt::gpu {

std::string describe(const std::string& activity, vk::Result result) {
    switch (result) {
    case vk::Result::eErrorOutOfDeviceMemory:
        return activity + ": out of memory on the device; close other programs or ask for less";
    case vk::Result::eErrorOutOfHostMemory:
        return activity + ": out of memory";
    case vk::Result::eErrorDeviceLost:
        return activity + ": the device was lost, its driver crashed or stopped a command that took too "
                          "long; start again";
    case vk::Result::eErrorInitializationFailed:
        return activity + ": the driver does not start; is it installed completely?";
    default:
        return activity + ": Vulkan reports " + vk::to_string(result);
    }
}

void rethrow(const std::string& activity, const vk::SystemError& error) {
    throw Error(describe(activity, static_cast<vk::Result>(error.code().value())));
}

} // namespace nusselt::gpu
