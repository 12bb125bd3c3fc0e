#pragma once
/// Round lights as rays meet them: by the equation of the exact shape. Their triangles are for line samples of other lights.

#include "scene/model/scene.h"
#include "scene/model/vector_math.h"
#include "visibility/embree_api.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nusselt::visibility {

/// A round light in the space of its unit sphere, where ellipses lie in the plane z = 0.
struct RoundSurface {
    const scene::Scene* scene;
    std::uint32_t light;       ///< its number among all lights of the scene
    std::uint32_t round_light; ///< its number among the round lights
    std::uint32_t triangle;    ///< one of its triangles in the scene, which has its material
    std::array<double, 3> center;
    std::array<double, 9> inverse; ///< rows; from world space
    std::array<float, 3> lower, upper;
    double rounding;  ///< how far single precision moves points of the surface [m]
    double shrinkage; ///< of solid lights, the same as a share of the shape
    bool is_flat;
    bool is_partial; ///< whether rays meet the surface with a probability: see Presence
};

/// Texture coordinates as scene::surface() gives them. \param point on the unit sphere, or in the unit disk
scene::Float2 texture_coordinates(const RoundSurface& surface, const scene::Double3& point);

/// The round lights with a surface, unless its alpha is 0 everywhere, or it has coordinates that are not finite or beyond 1.8e18.
std::vector<RoundSurface> make_round_surfaces(const scene::Scene& scene);

/// Makes Embree ask a geometry of its type for users about these lights. Hits have the point of the unit sphere in place of the
/// normal. \param surfaces must outlive the geometry
void set_surfaces(RTCGeometry geometry, const std::vector<RoundSurface>& surfaces);

} // namespace nusselt::visibility
