#pragma once
/// What shaders see of the memory of a device.

#include "gpu/acceleration_structure.h"
#include "gpu/buffer.h"

#include <cstdint>
#include <span>

namespace nusselt::gpu {

/// Set 0 of shaders: storage buffers, then acceleration structures.
class ShaderBindings {
public:
    /// \param storage_buffers how many: bindings 0 to this, exclusive.
    /// \param ray_scenes      how many acceleration structures: the bindings after those.
    /// \param stages          that see them.
    ShaderBindings(const Device& device, std::uint32_t storage_buffers, std::uint32_t ray_scenes,
                   vk::ShaderStageFlags stages);

    vk::DescriptorSetLayout layout() const { return *layout_; }
    vk::DescriptorSet handle() const { return set_; }

    /// The buffers that the next commands use, in the order of their bindings. Not while commands run.
    void bind(std::span<const Buffer* const> buffers);
    /// \param scene what the only ray scene of the next commands is. Not while commands run.
    void bind(const AccelerationStructure& scene);

private:
    const Device* device_;
    std::uint32_t storage_buffers_, ray_scenes_;
    vk::raii::DescriptorSetLayout layout_;
    vk::raii::DescriptorPool pool_;
    vk::DescriptorSet set_; ///< freed with its pool
};

} // namespace nusselt::gpu
