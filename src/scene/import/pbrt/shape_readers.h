#pragma once
/// One function for each type of shape. All throw SceneError.

#include "scene/import/pbrt/shape_directive.h"

namespace nusselt::scene {

Geometry read_triangle_mesh(ShapeDirective& shape, Warnings& warnings);
/// The mesh itself is read later.
Geometry read_ply_mesh(ShapeDirective& shape, Warnings& warnings);
/// The control mesh of a subdivision surface.
Geometry read_loop_subdivision(ShapeDirective& shape, Warnings& warnings);
Geometry read_quad(ShapeDirective& shape, Warnings& warnings);
Geometry read_polygon(ShapeDirective& shape, Warnings& warnings);
Geometry read_bilinear_mesh(ShapeDirective& shape, Warnings& warnings);
Geometry read_sphere(ShapeDirective& shape, Warnings& warnings);
Geometry read_disk(ShapeDirective& shape, Warnings& warnings);
Geometry read_cylinder(ShapeDirective& shape, Warnings& warnings);
Geometry read_line(ShapeDirective& shape, Warnings& warnings);

/// The parameter "phimax" [degrees].
double read_sweep(ShapeDirective& shape);

} // namespace nusselt::scene
