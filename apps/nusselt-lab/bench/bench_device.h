#pragma once
/// The description of the device in benchmarks on a GPU.

#include "gpu/device.h"
#include "lab/results/results.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nusselt::app {

/// Adds --device.
void add_device_option(CLI::App& command, std::optional<std::string>& device);

/// The name of the clock.
std::string text_of_clock(gpu::Clock clock);

/// The number of threads of llvmpipe, in words; empty for other devices.
/// \param threads see lab::llvmpipe_threads()
std::string text_of_threads(const std::optional<std::string>& threads);

/// Prints two lines: the device, and the clock with remarks.
/// \param threads as text_of_threads() returns it
/// \param remark  after the clock, as in "; fma rounds once"
void print_device(const gpu::DeviceDescription& device, gpu::Clock clock, const std::string& remark,
                  const std::string& threads);

/// The same for lab::Results.
std::vector<std::pair<std::string, lab::Cell>>
device_settings(const gpu::DeviceDescription& device, gpu::Clock clock,
                const std::optional<std::string>& llvmpipe_threads);

} // namespace nusselt::app
