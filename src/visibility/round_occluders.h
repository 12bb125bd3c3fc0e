#pragma once
/// Round lights as shadow rays meet them: by the equation of the exact shape. Most shadow rays to a light end next to it, and would
/// search the thousands of triangles that cameras see.

#include "scene/model/scene.h"
#include "visibility/embree_api.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nusselt::visibility {

/// A round light in the space of its unit sphere, where ellipses lie in the plane z = 0.
struct RoundOccluder {
    std::array<double, 3> center;
    std::array<double, 9> inverse; ///< rows; from world space
    std::array<float, 3> lower, upper;
    double shell; ///< see scene::round_shells()
    bool is_flat;
};

struct RoundOccluders {
    std::vector<RoundOccluder> lights;
    std::vector<std::uint32_t> triangles; ///< of these lights, in ascending order
};

/// The round lights with a surface that is always there. Others stay triangles for shadow rays.
RoundOccluders make_round_occluders(const scene::Scene& scene);

/// Makes Embree ask a geometry of its type for users about these lights. \param occluders must outlive the geometry
void set_occluders(RTCGeometry geometry, const std::vector<RoundOccluder>& occluders);

} // namespace nusselt::visibility
