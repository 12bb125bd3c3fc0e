#pragma once
/// Triangle meshes as importers read them.

#include "scene/model/scene.h"

#include <cstddef>
#include <vector>

namespace nusselt::scene {

struct Mesh {
    std::vector<Float3> positions;
    std::vector<Float3> normals; ///< empty or as long as positions
    std::vector<Float2> uvs;     ///< empty or as long as positions
    std::vector<Triangle> triangles;
    std::size_t degenerate_triangles = 0; ///< left out
};

/// The sum of the areas of all triangles, counting one side [m^2].
double area(const Mesh& mesh);

} // namespace nusselt::scene
