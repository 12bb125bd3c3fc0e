#pragma once
/// The visible parts of lines of a light, by the hierarchy and by all triangles.

#include "scene/model/scene.h"
#include "visibility/line_bvh.h"
#include "visibility/line_traversal.h"

#include <vector>

namespace nusselt::visibility_test {

/// A point and lines of a light in the direction of one angle.
struct LineQuery {
    Vec3<float> point;
    std::int32_t light = 0;
    float angle = 0;
    int line_count = 16;
};

/// The visible parts of a line: disjoint and in order.
struct VisibleLine {
    Chord<float> whole;
    std::vector<Interval<float>> parts;
};

ConvexPolygon<float, 4> polygon_of(const scene::Scene& scene, std::int32_t light);

SeenLight seen_light(const scene::Scene& scene, const LineQuery& query);

/// \tparam kLanes lines per pack
template <int kLanes>
std::vector<VisibleLine> trace(const scene::Scene& scene, const visibility::LineBvh& bvh,
                               const LineQuery& query);

/// Cuts lines by each triangle of the world that is always there.
std::vector<VisibleLine> cut_by_all(const scene::Scene& scene, const LineQuery& query);

/// Length of what is visible in one but not in the other, as a share of the lines.
double difference(const std::vector<VisibleLine>& a, const std::vector<VisibleLine>& b);

/// Visible length as a share of the lines.
double visible_share(const std::vector<VisibleLine>& lines);

/// Whether all parts are finite, in order and on their line.
bool are_valid(const std::vector<VisibleLine>& lines);

} // namespace nusselt::visibility_test
