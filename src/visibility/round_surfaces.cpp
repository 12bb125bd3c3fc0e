#include "visibility/round_surfaces.h"

#include "scene/model/bounds.h"
#include "scene/model/lights/round/round_axes.h"
#include "visibility/alpha.h"
#include "visibility/embree_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace nusselt::visibility {

namespace {

using scene::Double3;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

RoundSurface make_surface(const scene::Scene& scene, std::size_t index, std::uint32_t triangle) {
    const scene::RoundLight& light = scene.lights.of<scene::RoundLight>()[index];
    RoundSurface result{};
    result.scene = &scene;
    result.light = static_cast<std::uint32_t>(scene.triangle_light[triangle]);
    result.round_light = static_cast<std::uint32_t>(index);
    result.triangle = triangle;
    result.is_flat = is_flat(light);
    result.is_partial = presence_of(scene.materials[scene.triangle_material[triangle]]) == Presence::partial;
    const Double3 u = to_double(light.u), v = to_double(light.v);
    const scene::RoundAxes axes(u, v, result.is_flat ? normalized(cross(u, v)) : to_double(light.w));
    for (std::size_t i = 0; i < 3; ++i) {
        const Double3 row = axes.inverse_row(i);
        result.inverse[3 * i] = row.x;
        result.inverse[3 * i + 1] = row.y;
        result.inverse[3 * i + 2] = row.z;
    }
    const Double3 center = to_double(light.center);
    result.center = {center.x, center.y, center.z};
    scene::Bounds bounds;
    scene::LightKind<scene::RoundLight>::add_to(light, bounds);
    // Boxes must contain the light in single precision, too.
    const scene::Float3 low = to_float(bounds.low), high = to_float(bounds.high);
    const float lower[] = {low.x, low.y, low.z};
    const float upper[] = {high.x, high.y, high.z};
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        result.lower[i] = std::nextafter(lower[i], -kInfinity);
        result.upper[i] = std::nextafter(upper[i], kInfinity);
        largest = std::max({largest, std::fabs(double{lower[i]}), std::fabs(double{upper[i]})});
    }
    // Points of lights, which shadow rays end at, come from some operations of single precision.
    constexpr double kRounding = 4e-7;
    constexpr double kLeastShrinkage = 1e-5, kMostShrinkage = 1e-3;
    result.rounding = kRounding * largest;
    if (!result.is_flat)
        result.shrinkage = std::min(kLeastShrinkage + result.rounding / semi_axes(light)[2], kMostShrinkage);
    return result;
}

/// A vector in the space of the unit sphere.
Double3 to_unit(const RoundSurface& surface, const Double3& v) {
    const auto& m = surface.inverse;
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
}

/// A ray in the space of the unit sphere.
struct UnitRay {
    /// \param along of any length but 0
    UnitRay(const RoundSurface& surface, const scene::Float3& from, const scene::Float3& along)
        : origin(to_unit(
              surface, {from.x - surface.center[0], from.y - surface.center[1], from.z - surface.center[2]})),
          direction(to_unit(surface, to_double(along))) {}

    Double3 origin, direction;
};

/// Where a ray crosses a surface: up to two places, in the order of the ray.
class RoundCrossings {
public:
    /// \param radius of the unit sphere, 1 or a little less, at which the crossings are; flat surfaces ignore it
    RoundCrossings(const RoundSurface& surface, const UnitRay& ray, double radius = 1)
        : ray_(ray), is_flat_(surface.is_flat) {
        if (is_flat_) {
            middle_ = -ray.origin.z / ray.direction.z;
            const Double3 point = closest();
            // Comparisons with NaN are false.
            count_ = point.x * point.x + point.y * point.y <= 1 ? 1 : 0;
            return;
        }
        const double a = dot(ray.direction, ray.direction);
        middle_ = -dot(ray.origin, ray.direction) / a;
        // From the closest point, because the discriminant of the equation for t cancels for distant origins.
        const Double3 point = closest();
        const double gap = radius * radius - dot(point, point);
        if (!(gap >= 0)) return;
        half_ = std::sqrt(gap / a);
        count_ = 2;
    }

    RoundCrossings(const RoundSurface&, UnitRay&&, double = 1) = delete;

    int count() const { return count_; }
    /// As the ray counts, perhaps negative.
    double t(int i) const { return middle_ + sign(i) * half_; }
    /// Moved to the unit sphere, or in the unit disk.
    Double3 point(int i) const {
        if (!is_flat_) return normalized(closest() + (sign(i) * half_) * ray_.direction);
        const Double3 point = closest();
        return {point.x, point.y, 0};
    }

private:
    static double sign(int i) { return i == 0 ? -1 : 1; }
    Double3 closest() const { return ray_.origin + middle_ * ray_.direction; }

    const UnitRay& ray_; // a copy makes each ray wait
    double middle_ = 0, half_ = 0;
    int count_ = 0;
    bool is_flat_;
};

/// Whether a point lies in a solid light, or so close to it that rounding put it outside. NaN and infinity do not.
bool is_inside_or_near(const RoundSurface& surface, const Double3& point) {
    const auto& m = surface.inverse;
    // Towards the surface, the distance to the centre changes by this much per metre.
    const Double3 gradient = {m[0] * point.x + m[3] * point.y + m[6] * point.z,
                              m[1] * point.x + m[4] * point.y + m[7] * point.z,
                              m[2] * point.x + m[5] * point.y + m[8] * point.z};
    constexpr double kTolerance = 1e-5;
    return dot(point, point) - 1 <= 2 * (kTolerance + surface.rounding * length(gradient));
}

/// Whether a surface, as if it were everywhere, lies between the ends of a shadow ray. Rays end next to the lights that they
/// are for: up to rounding, points on the surface see all points of it that no other surface hides.
/// \param t_far may be infinite
/// \returns the crossings in the way, as bits
unsigned crossings_in_way(const RoundSurface& surface, const UnitRay& ray, double t_far) {
    const auto is_before_end = [&](double t) { return t > 0 && t < t_far; };
    if (surface.is_flat) {
        // Rounding moves the ends of rays to the light to either side of it.
        if (std::fabs(ray.origin.z + t_far * ray.direction.z) <= surface.rounding) return 0;
        const RoundCrossings crossings(surface, ray);
        return crossings.count() > 0 && is_before_end(crossings.t(0)) ? 1u : 0u;
    }
    // Solid lights are convex: from inside, only rays that end outside cross them.
    if (dot(ray.origin, ray.origin) < 1)
        return is_inside_or_near(surface, ray.origin + t_far * ray.direction) ? 0u : 2u;
    if (dot(ray.origin, ray.direction) >= 0) return 0;
    // From outside a slightly smaller shape counts: rays that end on the rim must not end in its shadow.
    const RoundCrossings crossings(surface, ray, 1 - surface.shrinkage);
    if (crossings.count() == 0 || !is_before_end(crossings.t(0))) return 0;
    return is_before_end(crossings.t(1)) ? 3u : 1u;
}

/// A lane of a packet of Embree.
struct Ray {
    Ray(RTCRayN* rays, unsigned n, unsigned i)
        : origin{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
          direction{RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)} {}
    scene::Float3 origin, direction;
};

/// Whether a surface is there for a ray. Both crossings get random numbers of their own.
bool is_there(const RoundSurface& surface, const Ray& ray, const RoundCrossings& crossings, int i) {
    if (!surface.is_partial) return true;
    const scene::Material& material =
        surface.scene->materials[surface.scene->triangle_material[surface.triangle]];
    const float alpha = alpha_at(*surface.scene, material, texture_coordinates(surface, crossings.point(i)));
    return random_of_hit(ray.origin, ray.direction, surface.triangle, static_cast<std::uint32_t>(i)) < alpha;
}

const RoundSurface& surface_of(const void* surfaces, unsigned primitive) {
    return static_cast<const RoundSurface*>(surfaces)[primitive];
}

void find_bounds(const RTCBoundsFunctionArguments* arguments) {
    const RoundSurface& surface = surface_of(arguments->geometryUserPtr, arguments->primID);
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = surface.lower[0];
    bounds.lower_y = surface.lower[1];
    bounds.lower_z = surface.lower[2];
    bounds.upper_x = surface.upper[0];
    bounds.upper_y = surface.upper[1];
    bounds.upper_z = surface.upper[2];
}

void find_hits(const RTCIntersectFunctionNArguments* arguments) {
    const RoundSurface& surface = surface_of(arguments->geometryUserPtr, arguments->primID);
    const unsigned n = arguments->N;
    RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, n);
    RTCHitN* const hits = RTCRayHitN_HitN(arguments->rayhit, n);
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] == 0) continue;
        const Ray ray(rays, n, i);
        const UnitRay unit(surface, ray.origin, ray.direction);
        const RoundCrossings crossings(surface, unit);
        for (int k = 0; k < crossings.count(); ++k) {
            const double t = crossings.t(k);
            if (!(t > RTCRayN_tnear(rays, n, i) && t < RTCRayN_tfar(rays, n, i))) continue;
            if (!is_there(surface, ray, crossings, k)) continue;
            const Double3 point = crossings.point(k);
            RTCRayN_tfar(rays, n, i) = static_cast<float>(t);
            RTCHitN_Ng_x(hits, n, i) = static_cast<float>(point.x);
            RTCHitN_Ng_y(hits, n, i) = static_cast<float>(point.y);
            RTCHitN_Ng_z(hits, n, i) = static_cast<float>(point.z);
            RTCHitN_u(hits, n, i) = RTCHitN_v(hits, n, i) = 0;
            RTCHitN_primID(hits, n, i) = arguments->primID;
            RTCHitN_geomID(hits, n, i) = arguments->geomID;
            RTCHitN_instID(hits, n, i, 0) = arguments->context->instID[0];
            break;
        }
    }
}

void find_shadows(const RTCOccludedFunctionNArguments* arguments) {
    const RoundSurface& surface = surface_of(arguments->geometryUserPtr, arguments->primID);
    const unsigned n = arguments->N;
    RTCRayN* const rays = arguments->ray;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] == 0) continue;
        const Ray ray(rays, n, i);
        const UnitRay unit(surface, ray.origin, ray.direction);
        const unsigned in_way = crossings_in_way(surface, unit, RTCRayN_tfar(rays, n, i));
        if (in_way == 0) continue;
        if (!surface.is_partial) {
            RTCRayN_tfar(rays, n, i) = -kInfinity;
            continue;
        }
        const RoundCrossings crossings(surface, unit);
        for (int k = 0; k < crossings.count(); ++k)
            if ((in_way >> k & 1u) != 0 && is_there(surface, ray, crossings, k))
                RTCRayN_tfar(rays, n, i) = -kInfinity;
    }
}

} // namespace

scene::Float2 texture_coordinates(const RoundSurface& surface, const Double3& point) {
    constexpr double kPi = std::numbers::pi;
    const double angle = std::atan2(point.y, point.x) / (2 * kPi);
    const double around = angle < 0 ? angle + 1 : angle;
    const double radius = std::hypot(point.x, point.y);
    const double along = surface.is_flat ? 1 - radius : std::atan2(radius, -point.z) / kPi;
    return {static_cast<float>(around), static_cast<float>(along)};
}

std::vector<RoundSurface> make_round_surfaces(const scene::Scene& scene) {
    std::vector<RoundSurface> result;
    std::vector<bool> is_known(scene.lights.of<scene::RoundLight>().size(), false);
    if (is_known.empty()) return result;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const std::int64_t light = round_light_of(scene, i);
        if (light < 0 || is_known[static_cast<std::size_t>(light)]) continue;
        is_known[static_cast<std::size_t>(light)] = true;
        if (presence_of(scene.materials[scene.triangle_material[i]]) == Presence::none) continue;
        RoundSurface surface =
            make_surface(scene, static_cast<std::size_t>(light), static_cast<std::uint32_t>(i));
        if (is_usable(surface.lower) && is_usable(surface.upper)) result.push_back(std::move(surface));
    }
    return result;
}

void set_surfaces(RTCGeometry geometry, const std::vector<RoundSurface>& surfaces) {
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(surfaces.size()));
    rtcSetGeometryUserData(geometry, const_cast<RoundSurface*>(surfaces.data()));
    rtcSetGeometryBoundsFunction(geometry, find_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, find_hits);
    rtcSetGeometryOccludedFunction(geometry, find_shadows);
}

} // namespace nusselt::visibility
