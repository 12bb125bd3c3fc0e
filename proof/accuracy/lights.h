#pragma once
/// Classes of hard lights in shading space. Their coordinates are floats, so that every number type gets the
/// same light; those without area and those seen edge-on are so exactly.

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/line_segment.h>

#include <random>
#include <vector>

namespace nusselt::proof {

using Engine = std::mt19937_64;

/// A convex polygon by its first vertex and its edges. The last edge closes it.
struct PolygonLight {
    Vec3<float> first;
    Vec3<float> edge[7];
    int count; ///< of vertices, 3 to 8
};

/// Who sees anything of a light.
enum class Visibility {
    everyone,
    no_one_above_horizon, ///< dark to the techniques that clip
    no_one,               ///< without area or length, or seen edge-on
};

struct PolygonClass {
    const char* name;
    Visibility visibility;
    int vertex_count;
    PolygonLight (*make)(Engine& engine);
};

struct LineClass {
    const char* name;
    Visibility visibility;
    LineSegment<float> (*make)(Engine& engine);
};

const std::vector<PolygonClass>& polygon_classes();
const std::vector<LineClass>& line_classes();

} // namespace nusselt::proof
