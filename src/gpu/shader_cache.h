#pragma once
/// Compiled shaders of a device.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include <vulkan/vulkan_raii.hpp>

namespace nusselt::gpu {

struct CompiledShader {
    vk::raii::PipelineLayout layout;
    vk::raii::Pipeline pipeline;
};

/// Keeps what drivers compiled, which takes them up to seconds, for whoever asks for the same again.
class ShaderCache {
public:
    /// The shader that was made for this key before, else a new one.
    const CompiledShader& get(const std::string& key, const std::function<CompiledShader()>& make);

    /// The number of shaders that were made.
    std::size_t size() const { return shaders_.size(); }

private:
    std::map<std::string, CompiledShader> shaders_;
};

/// Appends the bytes of a number to a key.
inline void append_to_key(std::string& key, std::uint64_t number) {
    key.append(reinterpret_cast<const char*>(&number), sizeof number);
}

} // namespace nusselt::gpu
