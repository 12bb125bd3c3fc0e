#include "gpu/instance.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace nusselt::gpu {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kNoDriver =
    "no Vulkan driver found; install the driver of your GPU, or the software device (mesa-vulkan-drivers)";

vk::raii::Context load() {
    try {
        return {};
    } catch (const std::runtime_error&) {
        throw NoDevice(
            "no Vulkan loader found; install libvulkan1 and the driver of your GPU, or the software "
            "device (mesa-vulkan-drivers)");
    }
}

bool has_validation_layer(const vk::raii::Context& context) {
    const auto layers = context.enumerateInstanceLayerProperties();
    return std::any_of(layers.begin(), layers.end(), [](const vk::LayerProperties& layer) {
        return std::strcmp(layer.layerName, kValidationLayer) == 0;
    });
}

/// A template, as newer versions of vulkan.hpp take a function with the C++ types, older ones with those of C.
template <class Severity, class Types, class Data>
VKAPI_ATTR VkBool32 VKAPI_CALL note(Severity, Types, const Data* data, void* log) {
    static_cast<ValidationLog*>(log)->add(data->pMessage);
    return VK_FALSE;
}

vk::raii::Instance make_instance(const vk::raii::Context& context, std::uint32_t version, bool validates,
                                 const vk::AllocationCallbacks* allocator) {
    const vk::ApplicationInfo application("nusselt", 1, "nusselt", 1, version);
    std::vector<const char*> layers, extensions;
    if (validates) {
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    try {
        return {context, vk::InstanceCreateInfo({}, &application, layers, extensions), allocator};
    } catch (const vk::IncompatibleDriverError&) {
        throw NoDevice(kNoDriver);
    } catch (const vk::SystemError& error) {
        rethrow("starting Vulkan", error);
    }
}

vk::raii::DebugUtilsMessengerEXT make_messenger(const vk::raii::Instance& instance, bool validates,
                                                ValidationLog& log) {
    if (!validates) return nullptr;
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    vk::DebugUtilsMessengerCreateInfoEXT info;
    info.messageSeverity = Severity::eWarning | Severity::eError;
    info.messageType = Type::eValidation | Type::ePerformance;
    info.pfnUserCallback = note;
    info.pUserData = &log;
    return {instance, info};
}

} // namespace

void ValidationLog::add(std::string message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
}

std::vector<std::string> ValidationLog::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

Instance::Instance(Validation validation, const vk::AllocationCallbacks* allocator)
    : log_(std::make_unique<ValidationLog>()),
      context_(load()),
      validates_(validation == Validation::on && has_validation_layer(context_)),
      version_(std::clamp(context_.enumerateInstanceVersion(), VK_API_VERSION_1_1, VK_API_VERSION_1_2)),
      instance_(make_instance(context_, version_, validates_, allocator)),
      messenger_(make_messenger(instance_, validates_, *log_)) {}

std::vector<vk::raii::PhysicalDevice> Instance::devices() const {
    std::vector<vk::raii::PhysicalDevice> usable;
    try {
        for (auto& device : instance_.enumeratePhysicalDevices()) {
            const auto families = device.getQueueFamilyProperties();
            const bool computes = std::any_of(families.begin(), families.end(), [](const auto& family) {
                return static_cast<bool>(family.queueFlags & vk::QueueFlagBits::eCompute);
            });
            if (computes && device.getProperties().apiVersion >= VK_API_VERSION_1_1)
                usable.push_back(std::move(device));
        }
    } catch (const vk::SystemError& error) {
        rethrow("looking for Vulkan devices", error);
    }
    return usable;
}

} // namespace nusselt::gpu
