#include "gpu/device.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace nusselt::gpu {

namespace {

bool has_extension(const vk::raii::PhysicalDevice& device, const char* name) {
    const auto extensions = device.enumerateDeviceExtensionProperties();
    return std::any_of(extensions.begin(), extensions.end(), [&](const auto& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

/// Name and version.
std::string driver_of(const vk::raii::PhysicalDevice& device) {
    if (!has_extension(device, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME))
        return "driver version " + std::to_string(device.getProperties().driverVersion);
    const auto chain =
        device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    return std::string(driver.driverName) + ", " + std::string(driver.driverInfo);
}

DeviceDescription describe(const vk::raii::PhysicalDevice& device) {
    const vk::PhysicalDeviceProperties basic = device.getProperties();
    const auto kind = [&]() -> std::string {
        switch (basic.deviceType) {
        case vk::PhysicalDeviceType::eDiscreteGpu:
            return "discrete GPU";
        case vk::PhysicalDeviceType::eIntegratedGpu:
            return "integrated GPU";
        case vk::PhysicalDeviceType::eVirtualGpu:
            return "virtual GPU";
        case vk::PhysicalDeviceType::eCpu:
            return "CPU";
        default:
            return "other";
        }
    };
    const auto version = std::to_string(VK_API_VERSION_MAJOR(basic.apiVersion)) + "." +
                         std::to_string(VK_API_VERSION_MINOR(basic.apiVersion)) + "." +
                         std::to_string(VK_API_VERSION_PATCH(basic.apiVersion));
    const bool is_software = basic.deviceType == vk::PhysicalDeviceType::eCpu;
    return {basic.deviceName, driver_of(device), kind(), is_software, version};
}

/// The lower the better.
int rank(const vk::raii::PhysicalDevice& device) {
    constexpr vk::PhysicalDeviceType kOrder[] = {
        vk::PhysicalDeviceType::eDiscreteGpu, vk::PhysicalDeviceType::eIntegratedGpu,
        vk::PhysicalDeviceType::eVirtualGpu, vk::PhysicalDeviceType::eOther, vk::PhysicalDeviceType::eCpu};
    return static_cast<int>(
        std::find(std::begin(kOrder), std::end(kOrder), device.getProperties().deviceType) -
        std::begin(kOrder));
}

std::string lower_case(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::optional<std::size_t> find(const std::vector<vk::raii::PhysicalDevice>& devices,
                                const std::string& choice) {
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (choice == std::to_string(i)) return i;
    // A number is an index, not a part of a version in some name.
    if (choice.find_first_not_of("0123456789") == std::string::npos) return std::nullopt;
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (lower_case(describe(devices[i]).name).find(lower_case(choice)) != std::string::npos) return i;
    return std::nullopt;
}

vk::raii::PhysicalDevice choose(const Instance& instance, const DeviceOptions& options) {
    std::vector<vk::raii::PhysicalDevice> devices = instance.devices();
    if (devices.empty())
        throw NoDevice(
            "no device supports Vulkan 1.1; install the driver of your GPU, or the software device "
            "(mesa-vulkan-drivers)");
    std::optional<std::string> choice = options.choice;
    if (const char* variable = std::getenv("NUSSELT_DEVICE");
        !choice && variable != nullptr && *variable != '\0')
        choice = variable;
    if (!choice)
        return std::move(*std::min_element(devices.begin(), devices.end(),
                                           [](const auto& a, const auto& b) { return rank(a) < rank(b); }));
    if (const auto found = find(devices, *choice)) return std::move(devices[*found]);
    std::string known;
    for (std::size_t i = 0; i < devices.size(); ++i)
        known += (i > 0 ? "; " : "") + std::to_string(i) + ": " + describe(devices[i]).name;
    throw NoDevice("unknown Vulkan device '" + *choice + "'; use one of " + known);
}

/// A queue for compute shaders: one that also draws if there is any, with timestamps if there are any.
std::uint32_t choose_queue_family(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    const auto merit = [](const vk::QueueFamilyProperties& family) {
        if (!(family.queueFlags & vk::QueueFlagBits::eCompute)) return 0;
        const bool draws = static_cast<bool>(family.queueFlags & vk::QueueFlagBits::eGraphics);
        return 1 + (draws ? 2 : 0) + (family.timestampValidBits > 0 ? 1 : 0);
    };
    const auto best = std::max_element(families.begin(), families.end(),
                                       [&](const auto& a, const auto& b) { return merit(a) < merit(b); });
    return static_cast<std::uint32_t>(best - families.begin());
}

constexpr const char* kRayExtensions[] = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                          VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                          VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

/// The number of images that shaders choose from; 0 if they cannot.
std::uint32_t indexed_images_of(const vk::raii::PhysicalDevice& device) {
    const auto features =
        device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceDescriptorIndexingFeatures>()
            .get<vk::PhysicalDeviceDescriptorIndexingFeatures>();
    if (!features.shaderSampledImageArrayNonUniformIndexing || !features.runtimeDescriptorArray ||
        !features.descriptorBindingSampledImageUpdateAfterBind)
        return 0;
    const auto limits =
        device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDescriptorIndexingProperties>()
            .get<vk::PhysicalDeviceDescriptorIndexingProperties>();
    // Leaves room for more buffers than any shader has.
    constexpr std::uint32_t kOtherResources = 64;
    return std::min({limits.maxPerStageDescriptorUpdateAfterBindSampledImages,
                     limits.maxDescriptorSetUpdateAfterBindSampledImages,
                     limits.maxPerStageUpdateAfterBindResources - kOtherResources});
}

DeviceFeatures features_of(const Instance& instance, const vk::raii::PhysicalDevice& device) {
    const std::uint32_t version = std::min(instance.version(), device.getProperties().apiVersion);
    if (version < VK_API_VERSION_1_2) return {};
    const auto basic =
        device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceBufferDeviceAddressFeatures>();
    DeviceFeatures features;
    features.indexed_images = indexed_images_of(device);
    features.buffer_addresses =
        basic.get<vk::PhysicalDeviceBufferDeviceAddressFeatures>().bufferDeviceAddress != 0;
    const bool has_extensions = std::all_of(std::begin(kRayExtensions), std::end(kRayExtensions),
                                            [&](const char* name) { return has_extension(device, name); });
    if (!features.buffer_addresses || !has_extensions) return features;
    const auto rays =
        device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                            vk::PhysicalDeviceRayQueryFeaturesKHR>();
    features.ray_queries =
        rays.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure != 0 &&
        rays.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery != 0;
    return features;
}

std::uint32_t scratch_alignment_of(const vk::raii::PhysicalDevice& device, const DeviceFeatures& features) {
    if (!features.ray_queries) return 1;
    return device
        .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
        .get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>()
        .minAccelerationStructureScratchOffsetAlignment;
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t queue_family,
                             const DeviceFeatures& features, const vk::AllocationCallbacks* allocator) {
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue({}, queue_family, 1, &priority);
    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceBufferDeviceAddressFeatures,
                       vk::PhysicalDeviceDescriptorIndexingFeatures,
                       vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                       vk::PhysicalDeviceRayQueryFeaturesKHR>
        chain;
    auto& info = chain.get<vk::DeviceCreateInfo>();
    info.setQueueCreateInfos(queue);
    chain.get<vk::PhysicalDeviceBufferDeviceAddressFeatures>().bufferDeviceAddress = true;
    auto& indexing = chain.get<vk::PhysicalDeviceDescriptorIndexingFeatures>();
    indexing.shaderSampledImageArrayNonUniformIndexing = true;
    indexing.runtimeDescriptorArray = true;
    indexing.descriptorBindingSampledImageUpdateAfterBind = true;
    chain.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure = true;
    chain.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery = true;
    if (features.ray_queries) {
        info.setPEnabledExtensionNames(kRayExtensions);
    } else {
        chain.unlink<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>();
        chain.unlink<vk::PhysicalDeviceRayQueryFeaturesKHR>();
    }
    if (features.indexed_images == 0) chain.unlink<vk::PhysicalDeviceDescriptorIndexingFeatures>();
    if (!features.buffer_addresses) chain.unlink<vk::PhysicalDeviceBufferDeviceAddressFeatures>();
    return {physical, info, allocator};
}

} // namespace

std::vector<DeviceDescription> list_devices() {
    std::vector<DeviceDescription> descriptions;
    try {
        const Instance instance(Validation::off);
        for (const auto& device : instance.devices()) descriptions.push_back(describe(device));
    } catch (const NoDevice&) {
        return {};
    }
    return descriptions;
}

DeviceDescription chosen_device(const DeviceOptions& options) {
    return describe(choose(Instance(Validation::off), options));
}

std::optional<std::string> why_no_device(const DeviceOptions& options) {
    try {
        static_cast<void>(chosen_device(options));
    } catch (const NoDevice& error) {
        return error.what();
    }
    return std::nullopt;
}

Device::Device(const DeviceOptions& options) try
    : instance_(options.validation, options.allocator),
      physical_(choose(instance_, options)),
      description_(describe(physical_)),
      limits_(physical_.getProperties().limits),
      features_(features_of(instance_, physical_)),
      scratch_alignment_(scratch_alignment_of(physical_, features_)),
      queue_family_(choose_queue_family(physical_)),
      clock_(physical_.getQueueFamilyProperties()[queue_family_].timestampValidBits > 0 ? Clock::timestamps
                                                                                        : Clock::wall),
      device_(make_device(physical_, queue_family_, features_, options.allocator)),
      queue_(device_, queue_family_, 0),
      pool_(device_, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient, queue_family_)) {
} catch (const vk::SystemError& error) {
    rethrow("starting a Vulkan device", error);
}

void Device::run(const Record& record) const {
    guarded(description_.name + ": running commands", [&] {
        const vk::raii::CommandBuffers buffers(
            device_, vk::CommandBufferAllocateInfo(*pool_, vk::CommandBufferLevel::ePrimary, 1));
        const Commands& commands = buffers.front();
        commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        full_barrier(commands);
        record(commands);
        full_barrier(commands);
        commands.end();
        const vk::raii::Fence done(device_, vk::FenceCreateInfo());
        queue_.submit(vk::SubmitInfo({}, {}, *commands), *done);
        while (device_.waitForFences(*done, true, std::numeric_limits<std::uint64_t>::max()) ==
               vk::Result::eTimeout) {
        }
    });
}

bool Device::draws() const {
    const auto families = physical_.getQueueFamilyProperties();
    return static_cast<bool>(families[queue_family_].queueFlags & vk::QueueFlagBits::eGraphics);
}

Clock Device::pass_clock() const {
    // Software devices draw when the image is used: their timestamps tell nothing about one of several passes.
    return description_.is_software ? Clock::wall : clock_;
}

double Device::time(const Record& record) const { return time_passes({&record, 1}).front(); }

std::vector<double> Device::time_passes(std::span<const Record> passes) const {
    std::vector<double> times;
    if ((passes.size() > 1 ? pass_clock() : clock_) == Clock::wall) {
        for (const Record& pass : passes) {
            const auto begin = std::chrono::steady_clock::now();
            run(pass);
            times.push_back(
                std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count());
        }
        return times;
    }
    return guarded(description_.name + ": taking times", [&] {
        const auto count = static_cast<std::uint32_t>(passes.size() + 1);
        const vk::raii::QueryPool timestamps(device_,
                                             vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, count));
        run([&](const Commands& commands) {
            commands.resetQueryPool(*timestamps, 0, count);
            commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *timestamps, 0);
            for (std::uint32_t i = 1; i < count; ++i) {
                passes[i - 1](commands);
                full_barrier(commands);
                commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *timestamps, i);
            }
        });
        const auto [result, ticks] = timestamps.getResults<std::uint64_t>(
            0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
            vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        // With fewer bits, the counter wraps around; differences of less than one period stay right.
        const std::uint32_t bits = physical_.getQueueFamilyProperties()[queue_family_].timestampValidBits;
        for (std::uint32_t i = 1; i < count; ++i) {
            const std::uint64_t elapsed = (ticks[i] - ticks[i - 1]) << (64 - bits) >> (64 - bits);
            times.push_back(static_cast<double>(elapsed) * static_cast<double>(limits_.timestampPeriod));
        }
        return times;
    });
}

std::optional<std::uint32_t> Device::memory_type_for(const vk::MemoryRequirements& requirements,
                                                     vk::MemoryPropertyFlags wanted) const {
    const vk::PhysicalDeviceMemoryProperties memory = physical_.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const bool fits = (requirements.memoryTypeBits >> i & 1) != 0 &&
                          (memory.memoryTypes[i].propertyFlags & wanted) == wanted &&
                          memory.memoryHeaps[memory.memoryTypes[i].heapIndex].size >= requirements.size;
        if (fits) return i;
    }
    return std::nullopt;
}

bool Device::has_memory(const vk::MemoryRequirements& requirements, vk::MemoryPropertyFlags wanted) const {
    return memory_type_for(requirements, wanted).has_value();
}

vk::raii::DeviceMemory Device::allocate(const vk::MemoryRequirements& requirements,
                                        vk::MemoryPropertyFlags wanted, vk::BufferUsageFlags use) const {
    const std::string activity =
        description_.name + ": allocating " + size_text(requirements.size) + " of memory";
    const std::optional<std::uint32_t> type = memory_type_for(requirements, wanted);
    if (!type) throw Error(gpu::describe(activity, vk::Result::eErrorOutOfDeviceMemory));
    vk::StructureChain<vk::MemoryAllocateInfo, vk::MemoryAllocateFlagsInfo> info(
        {requirements.size, *type}, {vk::MemoryAllocateFlagBits::eDeviceAddress});
    if (!(use & vk::BufferUsageFlagBits::eShaderDeviceAddress)) info.unlink<vk::MemoryAllocateFlagsInfo>();
    return guarded(activity,
                   [&] { return vk::raii::DeviceMemory(device_, info.get<vk::MemoryAllocateInfo>()); });
}

void full_barrier(const Device::Commands& commands) {
    using Access = vk::AccessFlagBits;
    const vk::MemoryBarrier barrier(Access::eMemoryWrite | Access::eHostWrite,
                                    Access::eMemoryRead | Access::eMemoryWrite | Access::eHostRead);
    const auto all = vk::PipelineStageFlagBits::eAllCommands | vk::PipelineStageFlagBits::eHost;
    commands.pipelineBarrier(all, all, {}, barrier, {}, {});
}

} // namespace nusselt::gpu
