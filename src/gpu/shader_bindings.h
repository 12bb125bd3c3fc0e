#pragma once
/// The memory of a device that shaders access.

#include "gpu/acceleration_structure.h"
#include "gpu/buffer.h"
#include "gpu/image_array.h"

#include <cstdint>
#include <span>
#include <vector>

namespace nusselt::gpu {

/// Set 0 of shaders: storage buffers, then acceleration structures. Set 1, if any: images.
class ShaderBindings {
public:
    /// \param storage_buffers how many: bindings 0 to this, exclusive.
    /// \param ray_scenes      how many acceleration structures: the bindings after those.
    /// \param images          null: none. Must outlive this.
    /// \param stages          that see set 0.
    /// \throws Error if the device does not bind as many buffers.
    ShaderBindings(const Device& device, std::uint32_t storage_buffers, std::uint32_t ray_scenes,
                   const ImageArray* images, vk::ShaderStageFlags stages);

    /// The layouts and the handles of all sets, in order.
    std::vector<vk::DescriptorSetLayout> layouts() const;
    std::vector<vk::DescriptorSet> handles() const;

    /// The buffers that the next commands use, in the order of their bindings. Not while commands run.
    void bind(std::span<const Buffer* const> buffers);
    /// \param scene what the only ray scene of the next commands is. Not while commands run.
    void bind(const AccelerationStructure& scene);

private:
    const Device* device_;
    std::uint32_t storage_buffers_, ray_scenes_;
    const ImageArray* images_;
    vk::raii::DescriptorSetLayout layout_;
    vk::raii::DescriptorPool pool_;
    vk::DescriptorSet set_; ///< freed with its pool
};

} // namespace nusselt::gpu
