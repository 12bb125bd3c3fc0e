#pragma once
/// From scenes to the records that shaders read.

#include "interface/scene.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::render_vulkan {

/// The arrays of shaders/interface/scene.h, but for textures.
struct SceneRecords {
    interface::SceneRecord scene;
    std::vector<interface::VertexRecord> vertices;    ///< of the scene, then of tubes
    std::vector<interface::TriangleRecord> triangles; ///< likewise
    std::vector<interface::InstanceRecord> instances;
    std::vector<interface::MaterialRecord> materials;
    std::vector<interface::PolygonLightRecord> polygon_lights;
    std::vector<scene::Float3> polygon_corners; ///< see shaders/passes/lights.glsl
    std::vector<interface::LineLightRecord> line_lights;
    std::uint32_t drawn_triangles = 0;
    int polygon_slots = 0;  ///< vertices that each polygonal light has room for, 4 or 8
    bool has_lines = false; ///< whether any light is linear, without extent
    bool has_tubes = false;
    bool has_alpha = false; ///< whether any surface is only partly there
};

/// \throws std::runtime_error if the scene has more data than 32-bit numbers reach, or an instance whose transform cannot
///         be inverted
SceneRecords make_scene_records(const scene::Scene& scene);

/// What the record says of the camera and the pixels.
/// \param radius of the scene, see scene::Scene [m]
void set_camera(const scene::Camera& camera, const scene::Film& film, double radius,
                interface::SceneRecord& record);

} // namespace nusselt::render_vulkan
