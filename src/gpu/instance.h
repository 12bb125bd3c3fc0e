#pragma once
/// The Vulkan loader, the devices that it finds, and what the validation layer says.

#include "gpu/error.h"

#include <memory>
#include <mutex>
#include <vector>

namespace nusselt::gpu {

/// Whether the Khronos validation layer watches all calls. It is silently left out where it is not installed:
/// Instance::validates() tells.
enum class Validation { off, on };

/// Messages of the validation layer, from any thread.
class ValidationLog {
public:
    void add(std::string message);
    /// The messages since the last call.
    std::vector<std::string> take();

private:
    std::mutex mutex_;
    std::vector<std::string> messages_;
};

/// An instance of Vulkan 1.2, or 1.1 where the loader knows no more, without any window system.
class Instance {
public:
    /// \param allocator see DeviceOptions
    /// \throws NoDevice if there is no Vulkan loader or no driver.
    /// \throws Error if a driver does not start.
    explicit Instance(Validation validation, const vk::AllocationCallbacks* allocator = nullptr);

    bool validates() const { return validates_; }
    std::uint32_t version() const { return version_; } ///< of Vulkan
    ValidationLog& log() const { return *log_; }

    /// All devices with Vulkan 1.1 and a queue for compute shaders, in the order of the loader.
    /// \throws Error if a driver does not start.
    std::vector<vk::raii::PhysicalDevice> devices() const;

private:
    std::unique_ptr<ValidationLog> log_; ///< the messenger keeps its address
    vk::raii::Context context_;
    bool validates_;
    std::uint32_t version_;
    vk::raii::Instance instance_;
    vk::raii::DebugUtilsMessengerEXT messenger_;
};

} // namespace nusselt::gpu
