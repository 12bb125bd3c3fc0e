#include "scene/import/pbrt/shape_readers.h"

namespace nusselt::scene {

namespace {

double read_length(ShapeDirective& shape, const std::string& name, double fallback) {
    const double value = shape.parameters.real(name, fallback);
    if (!(value > 0))
        throw SceneError(shape.parameters.location_of(name), "shape \"" + shape.type + "\": " + name +
                                                                 " must be positive, found " +
                                                                 to_text(value));
    return value;
}

double read_radius(ShapeDirective& shape, double fallback) { return read_length(shape, "radius", fallback); }

TubeModel read_tube_model(ParameterList& parameters) {
    const bool is_finite = parameters.boolean("finite", true);
    const std::string caps = parameters.string("caps", is_finite ? "bright" : "dark");
    if (caps != "bright" && caps != "dark")
        throw SceneError(parameters.location_of("caps"),
                         "shape \"line\": caps must be \"bright\" or \"dark\", found \"" + caps + "\"");
    if (!is_finite && caps == "bright")
        throw SceneError(parameters.location_of("caps"),
                         "shape \"line\": a tube with \"bool finite\" false has no caps");
    if (!is_finite) return TubeModel::linear;
    return caps == "bright" ? TubeModel::solid : TubeModel::open;
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
    if (const auto normal = parameters.point("N")) {
        tube.model = TubeModel::strip;
        tube.normal = *normal;
        tube.radius = 0.5 * read_length(shape, "width", 0);
        tube.radius_origin = parameters.location_of("width");
        return tube;
    }
    tube.model = read_tube_model(parameters);
    tube.radius = read_length(shape, "radius", 0);
    tube.radius_origin = parameters.location_of("radius");
    if (const auto axis = parameters.point("profileaxis")) tube.normal = *axis;
    return tube;
}

} // namespace nusselt::scene
