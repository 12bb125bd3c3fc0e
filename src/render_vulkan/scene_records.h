#pragma once
/// From scenes to the records that shaders read.

#include "interface/scene.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::render_vulkan {

/// What a scene has: the constants of shaders/passes/scene_kinds.glsl.
struct SceneKinds {
    bool polygons = false; ///< lights
    bool lines = false;    ///< linear lights without extent
    bool tubes = false;
    bool instances = false;
    bool partial = false;   ///< surfaces that are only partly there
    bool frostbite = false; ///< materials with a specular component
    std::uint32_t textures = 0;
};

/// Specialisation constants in the order of shaders/interface/settings.h.
std::vector<std::uint32_t> constants_of(const SceneKinds& kinds);

/// The arrays of shaders/interface/scene.h, but for textures.
struct SceneRecords {
    interface::SceneRecord scene;
    std::vector<interface::VertexRecord> vertices;    ///< of the scene, then of lights that are no surfaces
    std::vector<interface::TriangleRecord> triangles; ///< likewise
    std::vector<interface::InstanceRecord> instances;
    std::vector<interface::MaterialRecord> materials;
    std::vector<interface::PolygonLightRecord> polygon_lights;
    std::vector<scene::Float3> polygon_corners; ///< see shaders/passes/lights/polygon.glsl
    std::vector<interface::LineLightRecord> line_lights;
    std::uint32_t drawn_triangles = 0;
    int polygon_slots = 0; ///< vertices that each polygonal light has room for, 4 or 8
    SceneKinds kinds;
};

/// \throws std::runtime_error if the scene has more data than 32-bit numbers reach, or an instance whose transform cannot
///         be inverted
SceneRecords make_scene_records(const scene::Scene& scene);

/// What the record says of the camera and the pixels.
/// \param radius of the scene, see scene::Scene [m]
void set_camera(const scene::Camera& camera, const scene::Film& film, double radius,
                interface::SceneRecord& record);

} // namespace nusselt::render_vulkan
