#pragma once
/// The bounding volume hierarchy that shaders trace shadow rays with.

#include "interface/bvh.h"
#include "scene/model/scene.h"

#include <vector>

namespace nusselt::visibility {

/// The data of shaders/passes/trace_bvh.glsl. It has the surfaces that shadow rays can hit: those of triangles,
/// emitters included, and round lights in place of their triangles, but not the tubes of line lights, nor what has no
/// alpha at all.
struct TriangleBvh {
    std::vector<interface::BvhNode> nodes; ///< of the world, then of each object
    std::vector<interface::BvhTriangle> triangles;
    std::vector<interface::BvhInstance> instances; ///< one more than the scene has
};

/// Builds the hierarchy with the threads of the caller's oneTBB arena, whose number does not matter to the result.
/// Triangles and instances with coordinates that are not finite, or beyond 1.8e18, are left out, as in Embree's scenes.
/// \throws std::runtime_error for more than 2^30 triangles, a lack of memory and what else Embree's builder reports
TriangleBvh make_triangle_bvh(const scene::Scene& scene);

} // namespace nusselt::visibility
