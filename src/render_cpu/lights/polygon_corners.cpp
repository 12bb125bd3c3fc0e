#include "render_cpu/lights/polygon_corners.h"

#include "scene/model/library_vector.h"

#include <nusselt/geometry/convex_polygon.h>

#include <cstddef>

namespace nusselt::render_cpu {

namespace {

template <int N>
void add_corners(const scene::PolygonVertices& vertices, PolygonCorners& result) {
    Vec3<float> corners[N] = {};
    for (std::size_t j = 0; j < vertices.size(); ++j) corners[j] = to_vec(vertices[j]);
    const auto polygon = make_polygon<N>(corners, static_cast<int>(vertices.size()));
    for (int j = 0; j < N; ++j) result.corners.push_back(scene::to_float3(polygon.vertex[j]));
    for (int j = 0; j < N; ++j) result.corners.push_back(scene::to_float3(polygon.edge[j]));
    result.normal = scene::to_float3(polygon.normal);
}

} // namespace

std::int32_t slots_of(const scene::PolygonVertices& vertices) { return vertices.size() <= 4 ? 4 : 8; }

PolygonCorners::PolygonCorners(const scene::PolygonVertices& vertices) : slots(slots_of(vertices)) {
    if (slots == 4)
        add_corners<4>(vertices, *this);
    else
        add_corners<8>(vertices, *this);
}

} // namespace nusselt::render_cpu
