#pragma once
/// Compute shaders with storage buffers.

#include "gpu/shader_bindings.h"
#include "gpu/shader_cache.h"

#include <cstdint>
#include <initializer_list>
#include <span>

namespace nusselt::gpu {

/// The inputs of a shader.
struct ComputeInterface {
    std::uint32_t storage_buffers = 0;         ///< bindings 0 to this, exclusive, of set 0
    std::uint32_t ray_scenes = 0;              ///< acceleration structures: the bindings after those
    const ImageArray* images = nullptr;        ///< set 1, or none; must outlive the pipeline
    std::uint32_t push_constant_size = 0;      ///< [bytes]
    std::vector<std::uint32_t> constants = {}; ///< specialisation constants 0, 1, ...: the bits of each
};

/// A shader with what it is bound to. The shader is compiled once per device, whichever pipelines ask for it.
class ComputePipeline {
public:
    /// \param spirv a shader with the entry point `main`, as nusselt_add_shader() embeds it.
    /// \throws Error if the driver cannot compile it or runs out of memory.
    ComputePipeline(const Device& device, std::span<const std::uint32_t> spirv,
                    const ComputeInterface& interface);

    /// \copydoc ShaderBindings::bind
    void bind(std::initializer_list<const Buffer*> buffers) {
        bind(std::span(buffers.begin(), buffers.size()));
    }
    /// \copydoc ShaderBindings::bind
    void bind(std::span<const Buffer* const> buffers) { bindings_.bind(buffers); }
    /// \copydoc ShaderBindings::bind
    void bind(const AccelerationStructure& scene) { bindings_.bind(scene); }

    /// Records one dispatch.
    /// \param push     the push constants, exactly as large as the interface says.
    /// \param groups   number of work groups, in the first dimension.
    /// \param groups_y in the second one.
    void dispatch(const Device::Commands& commands, std::span<const std::byte> push, std::uint32_t groups,
                  std::uint32_t groups_y = 1) const;

private:
    std::uint32_t push_constant_size_;
    ShaderBindings bindings_;
    const CompiledShader* shader_; ///< lives as long as the device
};

} // namespace nusselt::gpu
