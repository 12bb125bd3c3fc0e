#pragma once
/// The rows of the table.

#include <vector>

#include "lab/timing/scalar/kernels.h"

#include <nusselt/related/line_projected_solid_angle_peters.h>
#include <nusselt/related/line_solid_angle_peters.h>
#include <nusselt/related/polygon_projected_solid_angle_peters.h>
#include <nusselt/related/polygon_solid_angle_peters.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

namespace nusselt::lab {

template <int N>
void add_polygons(std::vector<Row>& rows) {
    using Light = ConvexPolygon<float, N>;
    using Projected = PolygonProjectedSolidAngle<float, N>;
    using ProjectedPeters = PolygonProjectedSolidAnglePeters<float, N>;
    for (const LightClass& lights : {kDecentral, kCentral, kCrossing})
        rows.push_back(row<Light, Projected, ProjectedPeters>("PolygonProjectedSolidAngle", lights));
    rows.push_back(row<Light, PolygonSolidAngle<float, N>, PolygonSolidAnglePeters<float, N>>(
        "PolygonSolidAngle", kDecentral));
}

/// Polygons of 3 to 7 corners, then lines.
inline std::vector<Row> scalar_rows() {
    std::vector<Row> rows;
    add_polygons<3>(rows);
    add_polygons<4>(rows);
    add_polygons<5>(rows);
    add_polygons<6>(rows);
    add_polygons<7>(rows);
    using Light = LineSegment<float>;
    for (const LightClass& lights : {kLineAbove, kCrossing})
        rows.push_back(row<Light, LineProjectedSolidAngle<float>, LineProjectedSolidAnglePeters<float>>(
            "LineProjectedSolidAngle", lights));
    rows.push_back(
        row<Light, LineSolidAngle<float>, LineSolidAnglePeters<float>>("LineSolidAngle", kLineAbove));
    return rows;
}

} // namespace nusselt::lab
