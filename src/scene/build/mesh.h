#pragma once
/// What one shape contributes to the scene.

#include "scene/input/diagnostics.h"
#include "scene/model/scene.h"

#include <cstddef>
#include <vector>

namespace nusselt::scene {

struct Mesh {
    std::vector<Float3> positions;
    std::vector<Float3> normals; ///< empty or as long as positions
    std::vector<Float2> uvs;     ///< empty or as long as positions
    std::vector<Triangle> triangles;
    std::vector<std::int32_t> triangle_light; ///< empty, or per triangle an index into polygon_lights
    std::vector<PolygonLight> polygon_lights;
    std::vector<LineLight> line_lights;
    std::size_t degenerate_triangles = 0; ///< left out
    Warnings warnings;
};

} // namespace nusselt::scene
