#include "lab/figures/pixel_centres.h"

#include "render/ray_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nusselt::lab {

namespace {

using Vector = Vec3<float>;

Vector vector(const scene::Float3& v) { return {v.x, v.y, v.z}; }

} // namespace

void put_ray(const Vector& origin, const Vector& direction, float t_far, visibility::RayPacket<4>& rays) {
    const float o[] = {origin.x, origin.y, origin.z};
    const float d[] = {direction.x, direction.y, direction.z};
    for (int k = 0; k < 3; ++k) {
        rays.origin[k][0] = o[k];
        rays.direction[k][0] = d[k];
    }
    rays.t_far[0] = t_far;
}

PixelCentre see_centre(const scene::Scene& scene, const visibility::RayTracer& tracer, int x, int y) {
    const scene::Camera& camera = scene.camera;
    const float px = static_cast<float>(x) + 0.5f;
    const float py = static_cast<float>(y) + 0.5f;
    PixelCentre seen;
    seen.origin = vector(camera.origin) + px * vector(camera.origin_right) + py * vector(camera.origin_down);
    seen.direction = vector(camera.corner) + px * vector(camera.right) + py * vector(camera.down);
    visibility::RayPacket<4> rays = {};
    visibility::HitPacket<4> hits = {};
    put_ray(seen.origin, seen.direction, std::numeric_limits<float>::infinity(), rays);
    const visibility::PacketTracer<4>& packets = tracer;
    packets.intersect(tracer.context, 1, rays, hits);
    seen.triangle = hits.triangle[0];
    seen.line = hits.triangle[0] < 0 ? hits.light[0] : -1;
    if (seen.triangle < 0) return seen;
    const scene::Triangle& triangle = scene.triangles[static_cast<std::size_t>(seen.triangle)];
    const auto corner = [&](int k) { return vector(scene.positions[triangle.vertex[k]]); };
    const Vector e1 = corner(1) - corner(0), e2 = corner(2) - corner(0);
    seen.position = corner(0) + hits.u[0] * e1 + hits.v[0] * e2;
    const Vector normal = normalize(cross(e1, e2));
    seen.normal = dot(normal, seen.direction) > 0 ? -normal : normal;
    return seen;
}

Vector shadow_ray_offset(const scene::Scene& scene, const PixelCentre& seen) {
    const Vector& p = seen.position;
    const float coordinate = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    const float distance = render::kOffsetPerRadius * static_cast<float>(scene.radius) +
                           render::kOffsetPerCoordinate * coordinate;
    return distance * seen.normal;
}

} // namespace nusselt::lab
