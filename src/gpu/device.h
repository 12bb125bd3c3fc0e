#pragma once
/// A headless Vulkan device: commands are recorded, submitted and waited for. One thread at a time.

#include "gpu/instance.h"
#include "gpu/shader_cache.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nusselt::gpu {

struct DeviceOptions {
    /// Index as in list_devices(), or part of a name in upper or lower case. A number is always an index. Without it,
    /// the environment variable NUSSELT_DEVICE decides, likewise; without that a discrete GPU comes before an integrated
    /// one, and a software device last.
    std::optional<std::string> choice = {};
    Validation validation = Validation::off;
    /// The allocator of the driver for objects on the host, which must outlive the device. Null for its own one.
    const vk::AllocationCallbacks* allocator = nullptr;
};

struct DeviceDescription {
    std::string name;
    std::string driver;      ///< name and version
    std::string kind;        ///< "discrete GPU", "CPU", ...
    bool is_software;        ///< runs on the processor
    std::string api_version; ///< of Vulkan
};

/// Features of a device beyond Vulkan 1.1. All of them are switched on.
struct DeviceFeatures {
    bool buffer_addresses = false;    ///< buffers that shaders and builders reach by address
    bool ray_queries = false;         ///< with acceleration structures, see acceleration_structure.h
    std::uint32_t indexed_images = 0; ///< of how many shaders choose one per invocation, see image_array.h
};

/// The devices that can be chosen. Empty without a loader or driver.
/// \throws Error if a driver does not start.
std::vector<DeviceDescription> list_devices();

/// The device that Device(options) would use.
/// \throws NoDevice, Error as that does.
DeviceDescription chosen_device(const DeviceOptions& options = {});

/// The reason for which Device(options) would throw NoDevice; nothing if it would succeed.
/// \throws Error if a driver does not start.
std::optional<std::string> why_no_device(const DeviceOptions& options = {});

/// The clock of time().
enum class Clock {
    timestamps, ///< of the device: what the commands take
    wall,       ///< of the processor, where the device has none: with submission and waiting
};

class Device {
public:
    using Commands = vk::raii::CommandBuffer;
    using Record = std::function<void(const Commands&)>;

    /// \throws NoDevice if there is none, with what there is if one was asked for by name.
    /// \throws Error if a driver or the device does not start.
    explicit Device(const DeviceOptions& options = {});
    // Buffers and pipelines keep its address.
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceDescription& description() const { return description_; }
    const vk::PhysicalDeviceLimits& limits() const { return limits_; }
    const DeviceFeatures& features() const { return features_; }
    /// The clock of time_passes() for several passes.
    Clock pass_clock() const;
    /// The alignment of the scratch memory for building acceleration structures [bytes]; 1 without them.
    std::uint32_t scratch_alignment() const { return scratch_alignment_; }
    const vk::raii::Device& handle() const { return device_; }
    ShaderCache& shaders() const { return shaders_; }
    Clock clock() const { return clock_; }
    /// Whether there is a queue for drawing, not for computing only.
    bool draws() const;
    /// Whether the validation layer watches: it was asked for and is installed.
    bool validates() const { return instance_.validates(); }
    /// Warnings and errors of the validation layer since the last call.
    std::vector<std::string> take_validation_messages() const { return instance_.log().take(); }

    /// Submits what `record` records and waits until it is done. What earlier commands and the host wrote is
    /// visible to it, and what it writes is visible to the host.
    /// \throws Error if the device is lost.
    void run(const Record& record) const;

    /// Likewise. \return how long it took [ns].
    double time(const Record& record) const;

    /// Runs passes in turn, each as run() does, but in one submission where the device has timestamps that tell them
    /// apart.
    /// \return how long each of them took [ns].
    std::vector<double> time_passes(std::span<const Record> passes) const;

    /// \param wanted properties that the memory must have.
    /// \param use    of buffers in it.
    /// \throws Error if there is no such memory, or not enough.
    vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& requirements,
                                    vk::MemoryPropertyFlags wanted, vk::BufferUsageFlags use = {}) const;

    /// Whether there is memory with these properties for these requirements.
    bool has_memory(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags wanted) const;

private:
    std::optional<std::uint32_t> memory_type_for(const vk::MemoryRequirements& requirements,
                                                 vk::MemoryPropertyFlags wanted) const;

    Instance instance_;
    vk::raii::PhysicalDevice physical_;
    DeviceDescription description_;
    vk::PhysicalDeviceLimits limits_;
    DeviceFeatures features_;
    std::uint32_t scratch_alignment_;
    std::uint32_t queue_family_;
    Clock clock_;
    vk::raii::Device device_;
    vk::raii::Queue queue_;
    vk::raii::CommandPool pool_;
    mutable ShaderCache shaders_; ///< does not change what the device does
};

/// All that was written before is visible to all that follows.
void full_barrier(const Device::Commands& commands);

} // namespace nusselt::gpu
