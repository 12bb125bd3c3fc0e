#pragma once
/// The space in which a round light is the unit sphere, or the unit disk at z = 0.

#include "scene/model/scene.h"
#include "scene/model/vector_math.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nusselt::scene {

/// Whether a round light is a disk or an ellipse.
inline bool is_flat(const RoundLight& light) { return light.model == RoundModel::ellipse; }

/// Semi-diameters in double precision, and the cofactors of their matrix.
struct RoundAxes {
    RoundAxes(const Double3& u, const Double3& v, const Double3& w) : axis{u, v, w} {
        for (std::size_t i = 0; i < 3; ++i) cofactor[i] = cross(axis[(i + 1) % 3], axis[(i + 2) % 3]);
        volume = dot(axis[0], cofactor[0]);
    }
    explicit RoundAxes(const RoundLight& light)
        : RoundAxes(to_double(light.u), to_double(light.v), to_double(light.w)) {}

    /// The image of a point in the coordinates of the unit sphere.
    Double3 point(const Double3& p) const { return p.x * axis[0] + p.y * axis[1] + p.z * axis[2]; }
    /// The outward normal there, not of unit length.
    Double3 normal(const Double3& p) const {
        return (volume < 0 ? -1.0 : 1.0) * (p.x * cofactor[0] + p.y * cofactor[1] + p.z * cofactor[2]);
    }
    /// From a vector to the coordinates of the unit sphere; for ellipsoids.
    Double3 unit(const Double3& p) const {
        return {dot(cofactor[0], p) / volume, dot(cofactor[1], p) / volume, dot(cofactor[2], p) / volume};
    }
    /// A row of the inverse of the matrix; for ellipsoids.
    Double3 inverse_row(std::size_t i) const { return (1 / volume) * cofactor[i]; }

    std::array<Double3, 3> axis, cofactor;
    double volume;
};

/// The index among the round lights of a scene of the one to whose surface a triangle belongs; negative if there is none.
inline std::int64_t round_light_of(const Scene& scene, std::size_t triangle) {
    const std::int64_t index =
        scene.triangle_light[triangle] - static_cast<std::int64_t>(scene.lights.of<PolygonLight>().size());
    return index < static_cast<std::int64_t>(scene.lights.of<RoundLight>().size()) ? index : -1;
}

} // namespace nusselt::scene
