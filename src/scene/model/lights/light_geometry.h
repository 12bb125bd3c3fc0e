#pragma once
/// Types with which rows of kinds of light describe their geometry.

#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <cstdint>
#include <vector>

namespace nusselt::scene {

/// Triangles that only camera rays meet, for lights that are no surfaces of the scene. They cast no shadows.
struct LightMesh {
    std::vector<Float3> positions;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> lights; ///< for each triangle, the number of its light among all lights
};

/// The surface of a light that is one of the scene.
struct LightSurface {
    std::vector<Float3> positions;
    std::vector<Float3> normals; ///< as long as positions; 0 for the geometric normal
    std::vector<Float2> uvs;     ///< as long as positions
    std::vector<Triangle> triangles;
};

/// The mesh of all lights. Lights without extent give degenerate triangles.
/// \throws std::runtime_error if it has too many triangles, see check_counts()
LightMesh make_light_mesh(const Scene& scene);

/// The sums from which a centroid follows.
struct Moment {
    double weight = 0;
    Double3 sum;

    void add(double more, const Double3& p) {
        sum = sum + more * p;
        weight += more;
    }
    Double3 centroid() const { return (1 / weight) * sum; }
};

/// A ray by which a user selects a light.
struct SightRay {
    Double3 origin, direction;
    /// How far from a thin light the ray may pass, at the origin and per unit of the direction [m].
    Double3 tolerance, tolerance_growth;

    double tolerance_at(double t) const { return length(tolerance + t * tolerance_growth); }
};

} // namespace nusselt::scene
