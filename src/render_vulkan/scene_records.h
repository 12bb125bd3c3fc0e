#pragma once
/// Turns scenes into the records that shaders read.

#include "interface/scene.h"
#include "render_vulkan/lights/light_records.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::render_vulkan {

/// Describes which features a scene uses: the constants of shaders/passes/scene_kinds.glsl and lights.
struct SceneKinds {
    bool instances = false;
    bool partial = false;       ///< surfaces with an alpha below 1
    bool frostbite = false;     ///< materials of the Frostbite model
    bool phong = false;         ///< materials of the Phong model
    std::uint32_t textures = 0; ///< interface::MaterialRecord::texture_kinds of all materials
    decltype(LightRecords::has_shape) lights = {};
};

/// All specialisation constants by their numbers; those of settings are 0.
std::vector<std::uint32_t> constants_of(const SceneKinds& kinds);

/// The arrays of shaders/interface/scene.h, without those of textures.
struct SceneRecords {
    interface::SceneRecord scene;
    std::vector<interface::VertexRecord> vertices;    ///< of the scene, then of lights that are no surfaces
    std::vector<interface::TriangleRecord> triangles; ///< likewise
    std::vector<interface::InstanceRecord> instances;
    std::vector<interface::MaterialRecord> materials;
    LightRecords lights;
    std::uint32_t drawn_triangles = 0; ///< with those of boxes around round lights
    SceneKinds kinds;
};

/// \throws std::runtime_error if the scene has more data than 32-bit numbers reach, or an instance whose transform cannot
///         be inverted
SceneRecords make_scene_records(const scene::Scene& scene);

/// Writes the camera and the pixels to the record.
/// \param radius of the scene, see scene::Scene [m]
void set_camera(const scene::Camera& camera, const scene::Film& film, double radius,
                interface::SceneRecord& record);

} // namespace nusselt::render_vulkan
