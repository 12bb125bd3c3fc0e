#pragma once
/// The vertices and edges of polygons and portals, for shaders/passes/lights/stored_polygon.glsl.

#include "render_vulkan/lights/light_records.h"
#include "scene/model/lights/polygon_light.h"

#include <cstdint>

namespace nusselt::render_vulkan {

struct StoredPolygon {
    std::uint32_t first_word; ///< at interface::kPolygonCornersBinding
    scene::Float3 normal;
};

/// Appends the vertices of a polygon, then its edges, with the room of LightRecords::polygon_slots.
/// \param vertices 3 to that many
/// \throws std::runtime_error if 32 bits cannot number all coordinates
StoredPolygon add_corners(const scene::PolygonVertices& vertices, LightRecords& records);

} // namespace nusselt::render_vulkan
