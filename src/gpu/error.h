#pragma once
/// Errors of the GPU side, each one line for the user.

#include <cstdint>
#include <stdexcept>
#include <string>

#include <vulkan/vulkan_raii.hpp>

namespace nusselt::gpu {

/// The driver or a device cannot do what was asked for.
class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// There is no device to run on: no Vulkan loader, no driver, or none by the name that was asked for.
class NoDevice : public Error {
    using Error::Error;
};

/// A size for the user, as in "3 MiB", rounded up.
std::string size_text(std::uint64_t bytes);

/// One line that names the activity, what went wrong and what to do about it.
/// \param activity as in "DEVICE: a buffer of 3 MiB".
std::string describe(const std::string& activity, vk::Result result);

/// Throws what Vulkan reported as Error.
[[noreturn]] void rethrow(const std::string& activity, const vk::SystemError& error);

/// Calls a function and turns the exceptions of Vulkan into Error.
/// \param activity see describe().
template <class Function>
decltype(auto) guarded(const std::string& activity, const Function& function) {
    try {
        return function();
    } catch (const vk::SystemError& error) {
        rethrow(activity, error);
    }
}

} // namespace nusselt::gpu
