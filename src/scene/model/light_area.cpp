#include "scene/model/light_area.h"

#include "scene/model/polygon.h"
#include "scene/model/vector_math.h"

#include <numbers>

namespace nusselt::scene {

double area(const PolygonLight& light) {
    std::vector<Double3> vertices;
    for (const Float3& p : light.vertices) vertices.push_back(to_double(p));
    return 0.5 * length(area_vector(vertices));
}

double lateral_area(const LineLight& light) {
    return 2 * std::numbers::pi * static_cast<double>(light.radius) *
           length(to_double(light.end) - to_double(light.start));
}

double area(const LineLight& light) {
    const double radius = light.radius;
    const double caps = light.model == TubeModel::solid ? 2 * std::numbers::pi * radius * radius : 0;
    return lateral_area(light) + caps;
}

} // namespace nusselt::scene
