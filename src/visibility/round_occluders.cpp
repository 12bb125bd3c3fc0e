#include "visibility/round_occluders.h"

#include "scene/model/bounds.h"
#include "scene/model/lights/round/round_axes.h"
#include "scene/model/lights/round/round_shell.h"
#include "visibility/alpha.h"

#include <cmath>
#include <limits>

namespace nusselt::visibility {

namespace {

using scene::Double3;

RoundOccluder make_occluder(const scene::RoundLight& light, double shell) {
    RoundOccluder result{};
    const Double3 u = to_double(light.u), v = to_double(light.v);
    const scene::RoundAxes axes(u, v, is_flat(light) ? normalized(cross(u, v)) : to_double(light.w));
    for (std::size_t i = 0; i < 3; ++i) {
        const Double3 row = axes.inverse_row(i);
        result.inverse[3 * i] = row.x;
        result.inverse[3 * i + 1] = row.y;
        result.inverse[3 * i + 2] = row.z;
    }
    const Double3 center = to_double(light.center);
    result.center = {center.x, center.y, center.z};
    result.shell = shell;
    result.is_flat = is_flat(light);
    scene::Bounds bounds;
    scene::LightKind<scene::RoundLight>::add_to(light, bounds);
    // Boxes must contain the light in single precision, too.
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const scene::Float3 low = to_float(bounds.low), high = to_float(bounds.high);
    const float lower[] = {low.x, low.y, low.z};
    const float upper[] = {high.x, high.y, high.z};
    for (std::size_t i = 0; i < 3; ++i) {
        result.lower[i] = std::nextafter(lower[i], -kInfinity);
        result.upper[i] = std::nextafter(upper[i], kInfinity);
    }
    return result;
}

/// A ray in the space of the unit sphere, up to a time.
struct UnitRay {
    Double3 origin, direction;
    double end;
};

bool meets_ellipse(const UnitRay& ray) {
    const double t = -ray.origin.z / ray.direction.z;
    const double x = ray.origin.x + t * ray.direction.x;
    const double y = ray.origin.y + t * ray.direction.y;
    return t > 0 && t < ray.end && x * x + y * y <= 1;
}

/// Where a ray enters and leaves the sphere of a radius; NaN if it misses it.
struct Passage {
    Passage(const UnitRay& ray, double radius) {
        const double a = dot(ray.direction, ray.direction);
        const double half = dot(ray.origin, ray.direction);
        const double root = std::sqrt(half * half - a * (dot(ray.origin, ray.origin) - radius * radius));
        enter = (-half - root) / a;
        leave = (-half + root) / a;
    }
    double enter, leave;
};

bool meets_ellipsoid(const UnitRay& ray, double shell) {
    const double squared = dot(ray.origin, ray.origin);
    // From outside a slightly smaller shape counts: rays that end on its rim must not end in its shadow. Comparisons with NaN are
    // false.
    constexpr double kShrinkage = 1e-5;
    if (!(squared < 1)) {
        const Passage passage(ray, 1 - kShrinkage);
        return passage.enter > 0 && passage.enter < ray.end;
    }
    const Passage passage(ray, 1);
    if (!(passage.leave < ray.end)) return false;
    // Between triangles and light, as all points of the triangles: rays from their outside only leave the light.
    return squared < shell * shell || Passage(ray, shell).enter > 0;
}

void find_bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto* const occluders = static_cast<const RoundOccluder*>(arguments->geometryUserPtr);
    const RoundOccluder& occluder = occluders[arguments->primID];
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = occluder.lower[0];
    bounds.lower_y = occluder.lower[1];
    bounds.lower_z = occluder.lower[2];
    bounds.upper_x = occluder.upper[0];
    bounds.upper_y = occluder.upper[1];
    bounds.upper_z = occluder.upper[2];
}

/// Camera rays meet triangles instead.
void intersect_nothing(const RTCIntersectFunctionNArguments* /*arguments*/) {}

void find_shadows(const RTCOccludedFunctionNArguments* arguments) {
    const auto* const occluders = static_cast<const RoundOccluder*>(arguments->geometryUserPtr);
    const RoundOccluder& occluder = occluders[arguments->primID];
    const unsigned n = arguments->N;
    RTCRayN* const rays = arguments->ray;
    const auto unit = [&](double x, double y, double z) {
        const auto& m = occluder.inverse;
        return Double3{m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z,
                       m[6] * x + m[7] * y + m[8] * z};
    };
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] == 0) continue;
        const auto& center = occluder.center;
        const UnitRay ray{
            unit(RTCRayN_org_x(rays, n, i) - center[0], RTCRayN_org_y(rays, n, i) - center[1],
                 RTCRayN_org_z(rays, n, i) - center[2]),
            unit(RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)),
            RTCRayN_tfar(rays, n, i)};
        if (occluder.is_flat ? meets_ellipse(ray) : meets_ellipsoid(ray, occluder.shell))
            RTCRayN_tfar(rays, n, i) = -std::numeric_limits<float>::infinity();
    }
}

} // namespace

RoundOccluders make_round_occluders(const scene::Scene& scene) {
    RoundOccluders result;
    const std::vector<scene::RoundLight>& lights = scene.lights.of<scene::RoundLight>();
    if (lights.empty()) return result;
    std::vector<bool> has_surface(lights.size(), false), is_partial(lights.size(), false);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::int64_t index = round_light_of(scene, i);
        if (index < 0) continue;
        has_surface[static_cast<std::size_t>(index)] = true;
        if (presence_of(scene.materials[scene.triangle_material[i]]) != Presence::full)
            is_partial[static_cast<std::size_t>(index)] = true;
    }
    const std::vector<double> shells = round_shells(scene);
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (has_surface[i] && !is_partial[i]) result.lights.push_back(make_occluder(lights[i], shells[i]));
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::int64_t index = round_light_of(scene, i);
        if (index >= 0 && !is_partial[static_cast<std::size_t>(index)])
            result.triangles.push_back(static_cast<std::uint32_t>(i));
    }
    return result;
}

void set_occluders(RTCGeometry geometry, const std::vector<RoundOccluder>& occluders) {
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(occluders.size()));
    rtcSetGeometryUserData(geometry, const_cast<RoundOccluder*>(occluders.data()));
    rtcSetGeometryBoundsFunction(geometry, find_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect_nothing);
    rtcSetGeometryOccludedFunction(geometry, find_shadows);
}

} // namespace nusselt::visibility
