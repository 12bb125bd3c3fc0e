#pragma once
/// What rows of kinds of light say of their geometry.

#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <cstdint>
#include <vector>

namespace nusselt::scene {

/// Triangles that camera rays meet, for lights that are no surfaces of the scene: they cast no shadows.
struct LightMesh {
    std::vector<Float3> positions;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> lights; ///< of each triangle, its number among all lights of the scene
};

/// Of all lights. Lights without extent give degenerate triangles.
/// \throws std::runtime_error if there are too many, see check_counts()
LightMesh make_light_mesh(const Scene& scene);

/// Sums that give a centroid.
struct Moment {
    double weight = 0;
    Double3 sum;

    void add(double more, const Double3& p) {
        sum = sum + more * p;
        weight += more;
    }
    Double3 centroid() const { return (1 / weight) * sum; }
};

/// A ray that someone aims at a light.
struct SightRay {
    Double3 origin, direction;
    /// How far beside a thin light it may pass, at the origin and for each unit of the direction [m].
    Double3 tolerance, tolerance_growth;

    double tolerance_at(double t) const { return length(tolerance + t * tolerance_growth); }
};

} // namespace nusselt::scene
