#include "scene/import/pbrt/shape_readers.h"

namespace nusselt::scene {

namespace {

double read_radius(ShapeDirective& shape, double fallback) {
    const double radius = shape.parameters.real("radius", fallback);
    if (!(radius > 0))
        throw SceneError(shape.parameters.location_of("radius"),
                         "shape \"" + shape.type + "\": radius must be positive, found " + to_text(radius));
    return radius;
}

} // namespace

double read_sweep(ShapeDirective& shape) { return shape.parameters.real("phimax", 360); }

Geometry read_sphere(ShapeDirective& shape, Warnings&) {
    Sphere sphere;
    sphere.radius = read_radius(shape, 1);
    sphere.z_min = shape.parameters.real("zmin", -sphere.radius);
    sphere.z_max = shape.parameters.real("zmax", sphere.radius);
    sphere.sweep_degrees = read_sweep(shape);
    return sphere;
}

Geometry read_disk(ShapeDirective& shape, Warnings&) {
    ParameterList& parameters = shape.parameters;
    Disk disk;
    disk.radius = read_radius(shape, 1);
    disk.inner_radius = parameters.real("innerradius", 0);
    disk.height = parameters.real("height", 0);
    disk.sweep_degrees = read_sweep(shape);
    if (!(disk.inner_radius >= 0 && disk.inner_radius < disk.radius))
        throw SceneError(parameters.location_of("innerradius"),
                         "shape \"disk\": innerradius must be at least 0 and less than the radius, found " +
                             to_text(disk.inner_radius));
    return disk;
}

Geometry read_cylinder(ShapeDirective& shape, Warnings&) {
    Cylinder cylinder;
    cylinder.radius = read_radius(shape, 1);
    cylinder.z_min = shape.parameters.real("zmin", -1);
    cylinder.z_max = shape.parameters.real("zmax", 1);
    cylinder.sweep_degrees = read_sweep(shape);
    cylinder.radius_origin = shape.parameters.location_of("radius");
    return cylinder;
}

Geometry read_line(ShapeDirective& shape, Warnings&) {
    ParameterList& parameters = shape.parameters;
    std::vector<Float3> ends = parameters.points("P");
    for (const std::string_view name : {"p0", "p1"})
        if (const auto end = parameters.point(name)) ends.push_back(*end);
    if (ends.size() != 2)
        throw SceneError(
            parameters.location(),
            "shape \"line\": must have the parameters \"point3 p0\", \"point3 p1\" and \"float radius\"");
    Tube tube;
    tube.start = ends[0];
    tube.end = ends[1];
    tube.model = parameters.boolean("finite", true) ? TubeModel::solid : TubeModel::linear;
    tube.radius = read_radius(shape, 0);
    tube.radius_origin = parameters.location_of("radius");
    return tube;
}

} // namespace nusselt::scene
