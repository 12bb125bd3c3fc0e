#pragma once
/// Compute shaders with storage buffers.

#include "gpu/acceleration_structure.h"
#include "gpu/buffer.h"

#include <cstdint>
#include <initializer_list>
#include <span>

namespace nusselt::gpu {

/// What a shader expects from outside.
struct ComputeInterface {
    std::uint32_t storage_buffers = 0;         ///< bindings 0 to this, exclusive, of set 0
    std::uint32_t ray_scenes = 0;              ///< acceleration structures: the bindings after those
    std::uint32_t push_constant_size = 0;      ///< [bytes]
    std::vector<std::uint32_t> constants = {}; ///< specialisation constants 0, 1, ...: the bits of each
};

class ComputePipeline {
public:
    /// \param spirv a shader with the entry point `main`, as nusselt_add_shader() embeds it.
    /// \throws Error if the driver cannot compile it or runs out of memory.
    ComputePipeline(const Device& device, std::span<const std::uint32_t> spirv,
                    const ComputeInterface& interface);

    /// The buffers that the next dispatches use, in the order of their bindings. Not while commands run.
    void bind(std::initializer_list<const Buffer*> buffers);
    /// \param scene what the only ray scene of the next dispatches is. Not while commands run.
    void bind(const AccelerationStructure& scene);

    /// Records one dispatch.
    /// \param push the push constants, exactly as large as the interface says.
    /// \param groups number of work groups.
    void dispatch(const Device::Commands& commands, std::span<const std::byte> push,
                  std::uint32_t groups) const;

private:
    ComputeInterface interface_;
    const Device* device_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline pipeline_;
    vk::raii::DescriptorPool descriptor_pool_;
    vk::DescriptorSet descriptors_; ///< freed with its pool
};

} // namespace nusselt::gpu
