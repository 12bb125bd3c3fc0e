#include "bench_device.h"

#include "apps/common/help.h"

#include <fmt/core.h>

namespace nusselt::app {

void add_device_option(CLI::App& command, std::optional<std::string>& device) {
    command.add_option("--device", device, "Vulkan device, by its index or part of its name")
        ->type_name("DEVICE")
        ->default_str("the environment variable NUSSELT_DEVICE if set, else the fastest kind of GPU")
        ->group(kDeviceGroup);
}

std::string text_of_clock(gpu::Clock clock) {
    return clock == gpu::Clock::timestamps ? "timestamps of the device" : "wall clock";
}

std::string text_of_threads(const std::optional<std::string>& threads) {
    if (!threads) return "";
    return threads->empty() ? "a thread per core (LP_NUM_THREADS=1 times one)" : "LP_NUM_THREADS=" + *threads;
}

void print_device(const gpu::DeviceDescription& device, gpu::Clock clock, const std::string& remark,
                  const std::string& threads) {
    fmt::print("{} ({}), {}, Vulkan {}\n{}{}{}{}\n", device.name, device.kind, device.driver,
               device.api_version, text_of_clock(clock), remark, threads.empty() ? "" : "; ", threads);
}

std::vector<std::pair<std::string, lab::Cell>>
device_settings(const gpu::DeviceDescription& device, gpu::Clock clock,
                const std::optional<std::string>& llvmpipe_threads) {
    return {{"device", device.name},         {"kind", device.kind},
            {"driver", device.driver},       {"vulkan", device.api_version},
            {"clock", text_of_clock(clock)}, {"device_threads", text_of_threads(llvmpipe_threads)}};
}

} // namespace nusselt::app
