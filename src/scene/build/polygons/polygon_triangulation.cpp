#include "scene/build/polygons/polygon_triangulation.h"

#include "scene/model/polygon.h"

#include <nusselt/geometry/split_convex.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace nusselt::scene {

std::vector<Triangle> triangulate_polygon(const std::vector<Double3>& corners) {
    std::vector<Vec3<double>> outline;
    for (const Double3& p : corners) outline.push_back({p.x, p.y, p.z});
    if (outline.size() > kMaxConcaveCorners && length(area_vector(corners)) > 0 &&
        !is_strictly_convex(outline.data(), outline.size()))
        throw std::runtime_error("a face of " + std::to_string(corners.size()) +
                                 " corners is not convex; split non-convex faces of more than " +
                                 std::to_string(kMaxConcaveCorners) + " corners into triangles");
    std::vector<Triangle> triangles;
    for (const OutlineTriangle& t : triangulate(outline.data(), outline.size()))
        triangles.push_back({{static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                              static_cast<std::uint32_t>(t[2])}});
    return triangles;
}

} // namespace nusselt::scene
