#include "scene/import/pbrt/shape_directive.h"

#include "scene/build/build_shape.h"
#include "scene/import/pbrt/shape_readers.h"
#include "scene/import/pbrt/syntax/name_table.h"
#include "scene/model/vector_math.h"

#include <utility>

namespace nusselt::scene {

namespace {

using Reader = Geometry (*)(ShapeDirective&, Warnings&);
constexpr std::pair<std::string_view, Reader> kReaders[] = {{"trianglemesh", read_triangle_mesh},
                                                            {"plymesh", read_ply_mesh},
                                                            {"loopsubdiv", read_loop_subdivision},
                                                            {"bilinearmesh", read_bilinear_mesh},
                                                            {"quad", read_quad},
                                                            {"polygon", read_polygon},
                                                            {"sphere", read_sphere},
                                                            {"disk", read_disk},
                                                            {"cylinder", read_cylinder},
                                                            {"line", read_line}};

} // namespace

bool is_supported(std::string_view type) { return find_named(kReaders, type) != nullptr; }

bool is_surface(ShapeDirective& shape) {
    // The builder needs only this much now; the other parameters are read later.
    Geometry geometry;
    if (shape.type == "line") geometry = Tube();
    if (shape.type == "cylinder") {
        Cylinder cylinder;
        cylinder.sweep_degrees = read_sweep(shape);
        geometry = cylinder;
    }
    return becomes_surface(geometry, shape.emission, shape.world_from_object);
}

ShapeDescription read_shape(ShapeDirective& shape) {
    ShapeDescription result;
    const auto& [kind, read] = *find_row(kReaders, shape.type);
    result.kind = kind;
    result.origin = shape.parameters.location();
    result.geometry = read(shape, result.warnings);
    result.world_from_object = shape.world_from_object;
    result.reverse_orientation = shape.reverse_orientation;
    result.emission = shape.emission;
    result.material = shape.material;
    if (!is_black(shape.emission.radiance) && is_surface(shape))
        result.is_invisible = shape.parameters.real("alpha", 1) == 0;
    shape.parameters.warn_unused("shape \"" + shape.type + '"', result.warnings);
    return result;
}

} // namespace nusselt::scene
