#pragma once
/// Classes of hard lights in shading space, exactly representable in single precision.

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/line_segment.h>

#include <random>
#include <vector>

namespace nusselt::experiments {

using Engine = std::mt19937_64;

struct PolygonClass {
    const char* name;
    ConvexPolygon<float, 4> (*make)(Engine& engine);
};

struct LineClass {
    const char* name;
    LineSegment<float> (*make)(Engine& engine);
};

const std::vector<PolygonClass>& polygon_classes();
const std::vector<LineClass>& line_classes();

} // namespace nusselt::experiments
