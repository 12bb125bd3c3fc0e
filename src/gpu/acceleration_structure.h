#pragma once
/// Scenes for ray queries. Only on devices with DeviceFeatures::ray_queries.

#include "gpu/buffer.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nusselt::gpu {

/// Triangles that instances share: three indices of vertices for each. Either may be empty.
struct RayTriangles {
    std::span<const std::uint32_t> opaque;  ///< geometry 0: rays end there
    std::span<const std::uint32_t> partial; ///< geometry 1: shaders decide, once or more often for each
};

struct RayInstance {
    std::uint32_t triangles;                 ///< index of a RayTriangles
    std::array<float, 12> world_from_object; ///< rows of four: the linear part, then the translation
};

/// A scene of instances, immutable.
class AccelerationStructure {
public:
    /// Builds it on the device.
    /// \param positions three coordinates for each vertex of all triangles.
    /// \param triangles what instances are made of, at least one.
    /// \param instances their index is what shaders read as their custom index: fewer than 2^24. Those without triangles
    ///        are left out.
    /// \param boxes lower and upper corners: shaders decide whether rays meet what is in them. Their index is that of
    /// the primitive; they are no instance of the list.
    /// \throws Error if there are more instances, or the device has no memory for it.
    AccelerationStructure(const Device& device, std::span<const float> positions,
                          std::span<const RayTriangles> triangles, std::span<const RayInstance> instances,
                          std::span<const std::array<float, 6>> boxes);

    vk::AccelerationStructureKHR handle() const { return *top_.handles.front(); }

private:
    /// Structures of one kind, in memory of their own.
    struct Levels {
        Buffer memory;
        std::vector<vk::raii::AccelerationStructureKHR> handles;
    };
    struct Input;

    static Levels build(const Device& device, vk::AccelerationStructureTypeKHR type,
                        const std::vector<Input>& inputs);
    static Levels build_bottom(const Device& device, std::span<const float> positions,
                               std::span<const RayTriangles> triangles);
    static std::optional<Levels> build_boxes(const Device& device,
                                             std::span<const std::array<float, 6>> boxes);
    Levels build_top(const Device& device, std::span<const RayTriangles> triangles,
                     std::span<const RayInstance> instances) const;

    Levels bottom_;
    std::optional<Levels> boxes_;
    Levels top_;
};

} // namespace nusselt::gpu
