#include "scene/import/pbrt/shape_readers.h"
#include "scene/model/light_area.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace nusselt::scene {

namespace {

LineLight light_of_line(ShapeDirective& shape) {
    ParameterList& parameters = shape.parameters;
    std::vector<Float3> ends = parameters.points("P");
    for (const std::string_view name : {"p0", "p1"})
        if (const auto end = parameters.point(name)) ends.push_back(*end);
    if (ends.size() != 2)
        throw SceneError(
            parameters.location(),
            "shape \"line\": needs the parameters \"point3 p0\", \"point3 p1\" and \"float radius\"");
    const double scale = std::cbrt(std::fabs(linear_determinant(shape.world_from_object)));

    LineLight line;
    line.model = parameters.boolean("finite", true) ? TubeModel::solid : TubeModel::linear;
    line.begin = to_float(transform_point(shape.world_from_object, to_double(ends[0])));
    line.end = to_float(transform_point(shape.world_from_object, to_double(ends[1])));
    line.radius = static_cast<float>(parameters.real("radius", 0) * scale);
    return line;
}

/// By how much a transform scales the cross section of a cylinder around the z axis; nothing if that does not stay
/// round, or if the axis does not stay perpendicular to it.
std::optional<double> cross_section_scale(const Transform& world_from_object) {
    const Double3 x = transform_vector(world_from_object, {1, 0, 0});
    const Double3 y = transform_vector(world_from_object, {0, 1, 0});
    const Double3 z = transform_vector(world_from_object, {0, 0, 1});
    // Scene files round angles and matrices to a few digits.
    constexpr double kTolerance = 1e-3;
    const double scale = std::sqrt(length(x) * length(y));
    const bool is_round = std::fabs(length(x) - length(y)) <= kTolerance * scale &&
                          std::fabs(dot(x, y)) <= kTolerance * scale * scale;
    const double across = std::max(std::fabs(dot(x, z)), std::fabs(dot(y, z)));
    if (!is_round || across > kTolerance * scale * length(z)) return std::nullopt;
    return scale;
}

LineLight light_of_cylinder(ShapeDirective& shape, Warnings& warnings) {
    ParameterList& parameters = shape.parameters;
    if (shape.reverse_orientation)
        warnings.add(parameters.location(),
                     "shape \"cylinder\": ReverseOrientation is ignored, it emits outwards");

    LineLight line;
    line.model = TubeModel::solid;
    const double z_min = parameters.real("zmin", -1);
    const double z_max = parameters.real("zmax", 1);
    line.begin = to_float(transform_point(shape.world_from_object, {0, 0, z_min}));
    line.end = to_float(transform_point(shape.world_from_object, {0, 0, z_max}));
    const double scale = cross_section_scale(shape.world_from_object).value();
    line.radius = static_cast<float>(parameters.real("radius", 1) * scale);
    return line;
}

void check(const ShapeDirective& shape, const LineLight& line, double given_radius) {
    const ParameterList& parameters = shape.parameters;
    const std::string subject = "shape \"" + shape.type + "\": ";
    if (!is_valid_coordinate(line.begin) || !is_valid_coordinate(line.end))
        throw SceneError(parameters.location(), subject + "an end point is not finite or beyond 1e15 m");
    if (!(given_radius > 0))
        throw SceneError(parameters.location_of("radius"),
                         subject + "radius must be positive, found " + to_text(given_radius));
    if (!(line.radius > 0) || !is_valid_coordinate({line.radius, 0, 0}))
        throw SceneError(parameters.location_of("radius"),
                         subject + "radius must be positive and at most 1e15 m after the transform, found " +
                             to_text(line.radius));
    if (!(length(to_double(line.end) - to_double(line.begin)) > 0))
        throw SceneError(parameters.location(), subject + "both end points are equal");
}

} // namespace

bool is_tube(ShapeDirective& shape) {
    if (shape.type == "line") return true;
    return shape.type == "cylinder" && !is_black(shape.emission.radiance) &&
           shape.parameters.real("phimax", 360) == 360 && cross_section_scale(shape.world_from_object);
}

Mesh read_tube(ShapeDirective& shape) {
    Mesh mesh;
    ParameterList& parameters = shape.parameters;
    LineLight line = shape.type == "line" ? light_of_line(shape) : light_of_cylinder(shape, mesh.warnings);
    check(shape, line, parameters.real("radius", line.radius));
    if (is_black(shape.emission.radiance)) {
        mesh.warnings.add(parameters.location(),
                          "shape \"" + shape.type + "\": ignored where it does not emit light");
    } else {
        Emission outwards = shape.emission;
        outwards.two_sided = false;
        line.radiance = radiance_of(outwards, area(line), parameters.location());
        mesh.line_lights = {line};
    }
    return mesh;
}

} // namespace nusselt::scene
