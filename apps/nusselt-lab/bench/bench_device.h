#pragma once
/// What benchmarks on a GPU say about the device.

#include "gpu/device.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace nusselt::app {

/// Adds --device.
void add_device_option(CLI::App& command, std::optional<std::string>& device);

/// What times are taken with.
std::string text_of_clock(gpu::Clock clock);

/// What llvmpipe runs on; empty for others.
/// \param threads see lab::llvmpipe_threads()
std::string text_of_threads(const std::optional<std::string>& threads);

/// Two lines: the device, and the clock with what else is to be known.
/// \param threads as text_of_threads() says it
/// \param remark  after the clock, as in "; fma rounds once"
void print_device(const gpu::DeviceDescription& device, gpu::Clock clock, const std::string& remark,
                  const std::string& threads);

} // namespace nusselt::app
