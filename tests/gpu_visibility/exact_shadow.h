#pragma once
/// Shadow rays against all triangles of a scene in double precision, with a margin: single precision may decide either way
/// where a ray passes an edge, or ends on a triangle, within the margin.

#include "scene/model/scene.h"

#include <array>

namespace nusselt::gpu_visibility_test {

struct Ray {
    std::array<float, 3> origin;
    std::array<float, 3> direction;
    float t_far;
};

struct ExactShadow {
    bool hits = false;   ///< a triangle, by more than the margin
    bool unsure = false; ///< whether there is a triangle that it may hit or miss

    bool is_decided() const { return hits || !unsure; }
};

/// \param scene  without instances; alpha is ignored.
/// \param margin in units of the largest coordinate of the ray and the triangle.
ExactShadow exact_shadow(const scene::Scene& scene, const Ray& ray, double margin);

} // namespace nusselt::gpu_visibility_test
