#pragma once
/// One function for each type of shape: triangles in object space with the normal by the right-hand rule, or a tube in
/// world space. All throw SceneError.

#include "scene/import/pbrt/shapes.h"

namespace nusselt::scene {

Mesh read_triangle_mesh(ShapeDirective& shape);
Mesh read_ply_mesh(ShapeDirective& shape);
/// The control mesh of a subdivision surface.
Mesh read_loop_subdivision(ShapeDirective& shape);
Mesh read_quad(ShapeDirective& shape);
Mesh read_polygon(ShapeDirective& shape);
Mesh read_bilinear_mesh(ShapeDirective& shape);

// Tessellated: as many flat pieces as docs/materials.md says, with the area of the original.
Mesh read_sphere(ShapeDirective& shape);
Mesh read_disk(ShapeDirective& shape);
Mesh read_cylinder(ShapeDirective& shape);

/// A mesh with nothing but a line light.
Mesh read_tube(ShapeDirective& shape);

/// Throws SceneError unless an optional array has one value per vertex.
void check_length(const ShapeDirective& shape, std::string_view name, std::size_t found,
                  std::size_t expected);

} // namespace nusselt::scene
