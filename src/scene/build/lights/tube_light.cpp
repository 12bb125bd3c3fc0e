#include "scene/build/lights/tube_light.h"

#include "scene/build/lights/profiled_light.h"
#include "scene/build/lights/textured_tube.h"
#include "scene/model/profiles/line_profile.h"
#include "scene/model/vector_math.h"

#include <cmath>
#include <optional>
#include <utility>

namespace nusselt::scene {

namespace {

/// The factor by which a transform scales the cross section of a cylinder around the z axis; empty if the section does
/// not stay round and perpendicular to the axis.
std::optional<double> cross_section_scale(const Transform& world_from_object) {
    if (!is_affine(world_from_object)) return std::nullopt;
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

LineLight light_of(const Tube& tube, const Transform& world_from_object) {
    const double scale = std::cbrt(std::fabs(linear_determinant(world_from_object)));
    LineLight light;
    light.model = tube.model;
    light.start = to_float(transform_point(world_from_object, to_double(tube.start)));
    light.end = to_float(transform_point(world_from_object, to_double(tube.end)));
    light.radius = static_cast<float>(tube.radius * scale);
    if (tube.model == TubeModel::strip) {
        const Double3 axis = to_double(tube.end) - to_double(tube.start);
        const Double3 across = cross(to_double(tube.normal), axis);
        light.normal = to_float(normalized(
            cross(transform_vector(world_from_object, axis), transform_vector(world_from_object, across))));
    }
    return light;
}

LineLight light_of(const Cylinder& cylinder, const Transform& world_from_object) {
    LineLight light;
    light.model = TubeModel::solid;
    light.start = to_float(transform_point(world_from_object, {0, 0, cylinder.z_min}));
    light.end = to_float(transform_point(world_from_object, {0, 0, cylinder.z_max}));
    light.radius = static_cast<float>(cylinder.radius * cross_section_scale(world_from_object).value());
    return light;
}

void check(const ShapeDescription& shape, const LineLight& light, const Location& radius_origin) {
    const std::string subject = subject_of(shape) + ": ";
    if (!is_valid_coordinate(light.start) || !is_valid_coordinate(light.end))
        throw SceneError(shape.origin, subject + "the end points must be finite and within 1e15 m");
    if (!(light.radius > 0) || !is_valid_coordinate({light.radius, 0, 0}))
        throw SceneError(radius_origin,
                         subject + (light.model == TubeModel::strip ? "half the width" : "radius") +
                             " must be positive and at most 1e15 m after the transform, found " +
                             to_text(light.radius));
    if (!(length(to_double(light.end) - to_double(light.start)) > 0))
        throw SceneError(shape.origin, subject + "the end points must differ");
    if (light.model == TubeModel::strip && !(length(to_double(light.normal)) > 0))
        throw SceneError(shape.origin, subject + "the normal N must not be parallel to the line");
}

/// The axis of a profile: the normal of a strip, the direction that the shape gives, or that of z of its space.
Float3 profile_axis(const PlacedShape& placed, const LineLight& light) {
    if (light.model == TubeModel::strip) return light.normal;
    const Tube* const tube = std::get_if<Tube>(&placed.shape->geometry);
    const bool is_given = tube != nullptr && !is_black(tube->normal);
    const Double3 axis = is_given ? to_double(tube->normal) : Double3{0, 0, 1};
    return perpendicular_to_line(light, transform_vector(placed.world_from_object, axis));
}

} // namespace

bool becomes_tube(const Geometry& geometry, const Emission& emission, const Transform& world_from_object) {
    if (std::holds_alternative<Tube>(geometry)) return true;
    const Cylinder* cylinder = std::get_if<Cylinder>(&geometry);
    return cylinder != nullptr && !is_black(emission.radiance) && cylinder->sweep_degrees == 360 &&
           cross_section_scale(world_from_object);
}

BuiltShape build_tube(const PlacedShape& placed, const FormatWords& words) {
    const ShapeDescription& shape = *placed.shape;
    BuiltShape built;
    LineLight light;
    if (const Tube* tube = std::get_if<Tube>(&shape.geometry)) {
        light = light_of(*tube, placed.world_from_object);
        check(shape, light, tube->radius_origin);
    } else {
        const auto& cylinder = std::get<Cylinder>(shape.geometry);
        light = light_of(cylinder, placed.world_from_object);
        if (shape.reverse_orientation)
            built.warnings.add(shape.origin, subject_of(shape) + ": " + words.reversal +
                                                 " is ignored; tubes emit outwards");
        check(shape, light, cylinder.radius_origin);
    }
    if (is_black(shape.emission.radiance)) {
        built.warnings.add(shape.origin, subject_of(shape) + ": skipped because it does not emit light");
        return built;
    }
    ProfileRequest profile;
    if (shape.emission.profile != nullptr) profile = *shape.emission.profile;
    if (std::exchange(profile.honeycomb, {}) != HoneycombAngles{})
        built.warnings.add(shape.origin, "honeycombs of tubes",
                           subject_of(shape) + ": tubes have no honeycomb; it has no effect");
    if (has_effect(profile)) {
        light.normal = profile_axis(placed, light);
        add_profiled_line(shape, words, light, built);
        return built;
    }
    if (shape.emission.texture != nullptr) {
        add_textured_tube(shape, words, light, built);
        return built;
    }
    Emission outwards = shape.emission;
    outwards.two_sided = false;
    light.radiance = radiance_of(outwards, area(light), words.emission, shape.origin);
    built.lights.of<LineLight>() = {light};
    return built;
}

} // namespace nusselt::scene
