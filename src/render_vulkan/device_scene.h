#pragma once
/// A scene in the memory of a device, as passes need it.

#include "render_vulkan/scene_buffers.h"
#include "render_vulkan/scene_textures.h"
#include "render_vulkan/shadows/shadow_scene.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <optional>

namespace nusselt::render_vulkan {

/// Holds copies: it does not refer to the scene that it was made from.
class DeviceScene {
public:
    /// \param device must outlive this object
    /// \param textures see SceneTextures
    /// \throws std::runtime_error if the scene does not fit the device: see make_scene_records(), SceneTextures,
    ///         ShadowScene, upload().
    DeviceScene(const gpu::Device& device, const scene::Scene& scene, ShadowRays shadow_rays,
                std::optional<TextureAccess> textures = {});

    /// Sets another camera and film for the next frames. Accumulators that were made for films of another size must not
    /// add frames then. No commands may be running.
    void set_view(const scene::Camera& camera, const scene::Film& film);

    const gpu::Device& device() const { return device_; }
    const scene::Film& film() const { return film_; }
    std::uint32_t drawn_triangles() const { return drawn_triangles_; }
    int polygon_slots() const { return polygon_slots_; } ///< see LightRecords
    const SceneKinds& kinds() const { return kinds_; }
    std::uint32_t light_count() const { return light_count_; }
    const SceneBuffers& buffers() const { return buffers_; }
    const SceneTextures& textures() const { return textures_; }
    const gpu::Buffer& ltc_table() const { return ltc_table_; } ///< decoded
    const gpu::Buffer& blue_noise() const { return blue_noise_; }
    const ShadowScene& shadows() const { return shadows_; }

private:
    DeviceScene(const gpu::Device& device, const scene::Scene& scene, ShadowRays shadow_rays,
                std::optional<TextureAccess> textures, const SceneRecords& records);

    const gpu::Device& device_;
    scene::Film film_;
    double radius_; ///< of the scene [m]
    interface::SceneRecord record_;
    std::uint32_t drawn_triangles_;
    int polygon_slots_;
    std::uint32_t light_count_;
    SceneKinds kinds_;
    SceneBuffers buffers_;
    SceneTextures textures_;
    gpu::Buffer ltc_table_;
    gpu::Buffer blue_noise_;
    ShadowScene shadows_;
};

} // namespace nusselt::render_vulkan
