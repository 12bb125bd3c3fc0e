#include "gpu/acceleration_structure.h"

#include <algorithm>
#include <cassert>
#include <string>

namespace nusselt::gpu {

namespace {

using Use = vk::BufferUsageFlagBits;

constexpr vk::BufferUsageFlags kInputUse =
    Use::eAccelerationStructureBuildInputReadOnlyKHR | Use::eShaderDeviceAddress | Use::eTransferDst;

template <class T>
Buffer make_input(const Device& device, std::span<const T> values) {
    Buffer buffer(device, std::max(values.size_bytes(), sizeof(T)), Residence::device_local, kInputUse);
    if (!values.empty()) buffer.write(values);
    return buffer;
}

/// Scratch memory, with room to align it.
vk::DeviceAddress aligned(const Device& device, const Buffer& scratch) {
    const vk::DeviceAddress alignment = device.scratch_alignment();
    return (scratch.address() + alignment - 1) / alignment * alignment;
}

vk::AccelerationStructureGeometryKHR triangle_geometry(const Buffer& positions, std::size_t position_count,
                                                       const Buffer& indices, vk::GeometryFlagsKHR flags) {
    vk::AccelerationStructureGeometryTrianglesDataKHR data(
        vk::Format::eR32G32B32Sfloat, vk::DeviceOrHostAddressConstKHR(positions.address()), 3 * sizeof(float),
        static_cast<std::uint32_t>(position_count - 1), vk::IndexType::eUint32,
        vk::DeviceOrHostAddressConstKHR(indices.address()));
    return {vk::GeometryTypeKHR::eTriangles, data, flags};
}

} // namespace

AccelerationStructure::Level
AccelerationStructure::build(const Device& device, vk::AccelerationStructureTypeKHR type,
                             const std::vector<vk::AccelerationStructureGeometryKHR>& geometries,
                             const std::vector<std::uint32_t>& counts) {
    vk::AccelerationStructureBuildGeometryInfoKHR info(
        type, vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace);
    info.setGeometries(geometries);
    const vk::AccelerationStructureBuildSizesInfoKHR sizes =
        device.handle().getAccelerationStructureBuildSizesKHR(vk::AccelerationStructureBuildTypeKHR::eDevice,
                                                              info, counts);
    Buffer memory(device, sizes.accelerationStructureSize, Residence::device_local,
                  Use::eAccelerationStructureStorageKHR | Use::eShaderDeviceAddress);
    vk::raii::AccelerationStructureKHR handle(
        device.handle(), vk::AccelerationStructureCreateInfoKHR({}, memory.handle(), 0,
                                                                sizes.accelerationStructureSize, type));
    const Buffer scratch(device,
                         std::max<std::size_t>(sizes.buildScratchSize, 1) + device.scratch_alignment(),
                         Residence::device_local, Use::eStorageBuffer | Use::eShaderDeviceAddress);
    info.dstAccelerationStructure = *handle;
    info.scratchData.deviceAddress = aligned(device, scratch);
    std::vector<vk::AccelerationStructureBuildRangeInfoKHR> ranges;
    for (const std::uint32_t count : counts) ranges.emplace_back(count, 0, 0, 0);
    device.run([&](const Device::Commands& commands) {
        commands.buildAccelerationStructuresKHR(info, ranges.data());
    });
    return {std::move(memory), std::move(handle)};
}

AccelerationStructure::Level AccelerationStructure::build_triangles(const Device& device,
                                                                    const Buffer* positions,
                                                                    std::size_t position_count,
                                                                    const RayTriangles& triangles) {
    const Buffer opaque = make_input(device, triangles.opaque);
    const Buffer partial = make_input(device, triangles.partial);
    using Flag = vk::GeometryFlagBitsKHR;
    return build(device, vk::AccelerationStructureTypeKHR::eBottomLevel,
                 {triangle_geometry(*positions, position_count, opaque, Flag::eOpaque),
                  triangle_geometry(*positions, position_count, partial, Flag::eNoDuplicateAnyHitInvocation)},
                 {static_cast<std::uint32_t>(triangles.opaque.size() / 3),
                  static_cast<std::uint32_t>(triangles.partial.size() / 3)});
}

std::vector<AccelerationStructure::Level>
AccelerationStructure::build_all(const Device& device, std::span<const float> positions,
                                 std::span<const RayTriangles> triangles) {
    const Buffer vertices = make_input(device, positions);
    const std::size_t count = std::max<std::size_t>(positions.size() / 3, 1);
    std::vector<Level> levels;
    for (const RayTriangles& of_level : triangles)
        levels.push_back(build_triangles(device, &vertices, count, of_level));
    return levels;
}

AccelerationStructure::Level AccelerationStructure::build_top(const Device& device,
                                                              std::span<const RayTriangles> triangles,
                                                              std::span<const RayInstance> instances) const {
    if (instances.size() >= 1u << 24)
        throw Error(device.description().name + ": ray queries know fewer than 2^24 instances, not " +
                    std::to_string(instances.size()));
    std::vector<vk::AccelerationStructureInstanceKHR> inputs;
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        const RayInstance& instance = instances[i];
        const RayTriangles& content = triangles[instance.triangles];
        if (content.opaque.empty() && content.partial.empty()) continue;
        vk::TransformMatrixKHR transform;
        for (std::size_t k = 0; k < 12; ++k) transform.matrix[k / 4][k % 4] = instance.world_from_object[k];
        const vk::DeviceAddress address =
            device.handle().getAccelerationStructureAddressKHR({*bottom_[instance.triangles].handle});
        inputs.emplace_back(transform, i, 0xffu, 0u,
                            vk::GeometryInstanceFlagBitsKHR::eTriangleFacingCullDisable, address);
    }
    const Buffer buffer = make_input(device, std::span<const vk::AccelerationStructureInstanceKHR>(inputs));
    const vk::AccelerationStructureGeometryInstancesDataKHR data(
        false, vk::DeviceOrHostAddressConstKHR(buffer.address()));
    return build(device, vk::AccelerationStructureTypeKHR::eTopLevel,
                 {vk::AccelerationStructureGeometryKHR(vk::GeometryTypeKHR::eInstances, data)},
                 {static_cast<std::uint32_t>(inputs.size())});
}

AccelerationStructure::AccelerationStructure(const Device& device, std::span<const float> positions,
                                             std::span<const RayTriangles> triangles,
                                             std::span<const RayInstance> instances) try
    : bottom_(build_all(device, positions, triangles)), top_(build_top(device, triangles, instances)) {
    assert(device.features().ray_queries);
} catch (const vk::SystemError& error) {
    rethrow(device.description().name + ": building an acceleration structure", error);
}

} // namespace nusselt::gpu
