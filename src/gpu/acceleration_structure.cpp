#include "gpu/acceleration_structure.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>

namespace nusselt::gpu {

namespace {

using Use = vk::BufferUsageFlagBits;

constexpr vk::BufferUsageFlags kInputUse =
    Use::eAccelerationStructureBuildInputReadOnlyKHR | Use::eShaderDeviceAddress | Use::eTransferDst;
/// The alignment of acceleration structures in buffers [bytes].
constexpr std::size_t kAlignment = 256;

std::uint64_t aligned(std::uint64_t x, std::uint64_t alignment) {
    return (x + alignment - 1) / alignment * alignment;
}

template <class T>
Buffer make_input(const Device& device, std::span<const T> values) {
    Buffer buffer(device, std::max(values.size_bytes(), sizeof(T)), Residence::device_local, kInputUse);
    if (!values.empty()) buffer.write(values);
    return buffer;
}

} // namespace

/// The input of one structure.
struct AccelerationStructure::Input {
    std::vector<vk::AccelerationStructureGeometryKHR> geometries;
    std::vector<std::uint32_t> counts;       ///< of primitives
    std::vector<std::uint32_t> byte_offsets; ///< of their indices

    vk::AccelerationStructureBuildGeometryInfoKHR info(vk::AccelerationStructureTypeKHR type) const {
        vk::AccelerationStructureBuildGeometryInfoKHR result(
            type, vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace);
        result.setGeometries(geometries);
        return result;
    }
};

AccelerationStructure::Levels AccelerationStructure::build(const Device& device,
                                                           vk::AccelerationStructureTypeKHR type,
                                                           const std::vector<Input>& inputs) {
    // Scenes have more objects than drivers allow allocations: they share memory, and scratch memory in turn.
    std::vector<std::uint64_t> offsets = {0}, sizes;
    std::uint64_t scratch_size = 0;
    for (const Input& input : inputs) {
        const vk::AccelerationStructureBuildSizesInfoKHR needed =
            device.handle().getAccelerationStructureBuildSizesKHR(
                vk::AccelerationStructureBuildTypeKHR::eDevice, input.info(type), input.counts);
        sizes.push_back(needed.accelerationStructureSize);
        offsets.push_back(aligned(offsets.back() + needed.accelerationStructureSize, kAlignment));
        scratch_size = std::max(scratch_size, needed.buildScratchSize);
    }
    Levels levels{Buffer(device, offsets.back(), Residence::device_local,
                         Use::eAccelerationStructureStorageKHR | Use::eShaderDeviceAddress),
                  {}};
    for (std::size_t i = 0; i < inputs.size(); ++i)
        levels.handles.emplace_back(
            device.handle(),
            vk::AccelerationStructureCreateInfoKHR({}, levels.memory.handle(), offsets[i], sizes[i], type));
    const std::uint64_t alignment = device.scratch_alignment();
    const Buffer scratch(device, scratch_size + alignment, Residence::device_local,
                         Use::eStorageBuffer | Use::eShaderDeviceAddress);
    device.run([&](const Device::Commands& commands) {
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            auto info = inputs[i].info(type);
            info.dstAccelerationStructure = *levels.handles[i];
            info.scratchData.deviceAddress = aligned(scratch.address(), alignment);
            std::vector<vk::AccelerationStructureBuildRangeInfoKHR> ranges;
            for (std::size_t k = 0; k < inputs[i].counts.size(); ++k)
                ranges.emplace_back(inputs[i].counts[k], inputs[i].byte_offsets[k], 0, 0);
            commands.buildAccelerationStructuresKHR(info, ranges.data());
            full_barrier(commands);
        }
    });
    return levels;
}

AccelerationStructure::Levels AccelerationStructure::build_bottom(const Device& device,
                                                                  std::span<const float> positions,
                                                                  std::span<const RayTriangles> triangles) {
    std::vector<std::uint32_t> all_indices;
    for (const RayTriangles& part : triangles)
        for (const auto& indices : {part.opaque, part.partial})
            all_indices.insert(all_indices.end(), indices.begin(), indices.end());
    if (all_indices.size() > std::numeric_limits<std::uint32_t>::max() / sizeof(std::uint32_t))
        throw Error(device.description().name +
                    ": ray queries support at most 357 million triangles, found " +
                    std::to_string(all_indices.size() / 3) + "; use --shadow-rays bvh");
    const Buffer vertex_buffer = make_input(device, positions);
    const Buffer index_buffer = make_input(device, std::span<const std::uint32_t>(all_indices));
    const auto vertex_count = static_cast<std::uint32_t>(std::max<std::size_t>(positions.size() / 3, 1));
    const vk::AccelerationStructureGeometryTrianglesDataKHR data(
        vk::Format::eR32G32B32Sfloat, vk::DeviceOrHostAddressConstKHR(vertex_buffer.address()),
        3 * sizeof(float), vertex_count - 1, vk::IndexType::eUint32,
        vk::DeviceOrHostAddressConstKHR(index_buffer.address()));
    std::vector<Input> inputs;
    std::size_t first_index = 0;
    for (const RayTriangles& part : triangles) {
        Input& input = inputs.emplace_back();
        const auto add = [&](std::span<const std::uint32_t> indices, vk::GeometryFlagsKHR flags) {
            input.geometries.emplace_back(vk::GeometryTypeKHR::eTriangles, data, flags);
            input.counts.push_back(static_cast<std::uint32_t>(indices.size() / 3));
            input.byte_offsets.push_back(static_cast<std::uint32_t>(first_index * sizeof(std::uint32_t)));
            first_index += indices.size();
        };
        add(part.opaque, vk::GeometryFlagBitsKHR::eOpaque);
        add(part.partial, {});
    }
    return build(device, vk::AccelerationStructureTypeKHR::eBottomLevel, inputs);
}

std::optional<AccelerationStructure::Levels>
AccelerationStructure::build_boxes(const Device& device, std::span<const std::array<float, 6>> boxes) {
    static_assert(sizeof(boxes[0]) == sizeof(vk::AabbPositionsKHR));
    if (boxes.empty()) return {};
    const Buffer buffer = make_input(device, boxes);
    const vk::AccelerationStructureGeometryAabbsDataKHR data(
        vk::DeviceOrHostAddressConstKHR(buffer.address()), sizeof(boxes[0]));
    return build(device, vk::AccelerationStructureTypeKHR::eBottomLevel,
                 {{{vk::AccelerationStructureGeometryKHR(vk::GeometryTypeKHR::eAabbs, data)},
                   {static_cast<std::uint32_t>(boxes.size())},
                   {0}}});
}

AccelerationStructure::Levels AccelerationStructure::build_top(const Device& device,
                                                               std::span<const RayTriangles> triangles,
                                                               std::span<const RayInstance> instances) const {
    if (instances.size() >= 1u << 24)
        throw Error(device.description().name + ": ray queries support fewer than 2^24 instances, found " +
                    std::to_string(instances.size()) + "; use --shadow-rays bvh");
    std::vector<vk::AccelerationStructureInstanceKHR> records;
    const auto add = [&](const std::array<float, 12>& world_from_object, std::uint32_t index,
                         const vk::raii::AccelerationStructureKHR& structure) {
        vk::TransformMatrixKHR transform;
        for (std::size_t k = 0; k < 12; ++k) transform.matrix[k / 4][k % 4] = world_from_object[k];
        records.emplace_back(transform, index, 0xffu, 0u,
                             vk::GeometryInstanceFlagBitsKHR::eTriangleFacingCullDisable,
                             device.handle().getAccelerationStructureAddressKHR({*structure}));
    };
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        const RayInstance& instance = instances[i];
        const RayTriangles& content = triangles[instance.triangles];
        if (content.opaque.empty() && content.partial.empty()) continue;
        add(instance.world_from_object, i, bottom_.handles[instance.triangles]);
    }
    if (boxes_) add({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, 0, boxes_->handles.front());
    const Buffer buffer = make_input(device, std::span<const vk::AccelerationStructureInstanceKHR>(records));
    const vk::AccelerationStructureGeometryInstancesDataKHR data(
        false, vk::DeviceOrHostAddressConstKHR(buffer.address()));
    return build(device, vk::AccelerationStructureTypeKHR::eTopLevel,
                 {{{vk::AccelerationStructureGeometryKHR(vk::GeometryTypeKHR::eInstances, data)},
                   {static_cast<std::uint32_t>(records.size())},
                   {0}}});
}

AccelerationStructure::AccelerationStructure(const Device& device, std::span<const float> positions,
                                             std::span<const RayTriangles> triangles,
                                             std::span<const RayInstance> instances,
                                             std::span<const std::array<float, 6>> boxes) try
    : bottom_(build_bottom(device, positions, triangles)),
      boxes_(build_boxes(device, boxes)),
      top_(build_top(device, triangles, instances)) {
    assert(device.features().ray_queries);
} catch (const vk::SystemError& error) {
    rethrow(device.description().name + ": building an acceleration structure", error);
}

} // namespace nusselt::gpu
