#pragma once
/// Seeded generators of cases: points in closed meshes, and lights, points and occluders that break visibility.

#include <cstdint>
#include <vector>

#include <nusselt/geometry/convex_polygon.h>

#include "proof/shadows/closed_meshes.h"
#include "proof/shadows/shadow_case.h"

NUSSELT_NAMESPACE_BEGIN
namespace shadows {

using proof::kLinesPerCase;
using proof::Occluder;
using proof::ShadowCase;

namespace detail {

/// The distance at which a ray meets the mesh, in units of the direction.
inline double distance_to_surface(const Mesh& mesh, const Vec3<double>& direction) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3<double> a = mesh.vertices[i] - mesh.inside;
        const Vec3<double> b = mesh.vertices[j] - mesh.inside;
        const Vec3<double> c = mesh.vertices[k] - mesh.inside;
        const double x = dot(cross(b, c), direction), y = dot(cross(c, a), direction),
                     z = dot(cross(a, b), direction);
        const bool in_cone = (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
        const Vec3<double> normal = cross(b - a, c - a);
        const double distance = dot(normal, a) / dot(normal, direction);
        if (in_cone && distance > 0) nearest = std::min(nearest, distance);
    }
    return nearest;
}

inline void round_to(float (&target)[3], const Vec3<double>& v) {
    target[0] = static_cast<float>(v.x);
    target[1] = static_cast<float>(v.y);
    target[2] = static_cast<float>(v.z);
}

} // namespace detail

/// A point in a closed mesh and a light outside, of which nothing may be visible.
/// \param index   of the case; cases depend on it and the seed only.
/// \param storage of the occluders, to which the result points.
inline ShadowCase make_leak_case(std::uint64_t seed, std::uint64_t index, std::vector<Occluder>& storage) {
    hostile::RandomSource random(seed, index);
    Mesh mesh = make_closed_mesh(random);
    // Some meshes stay aligned with the axes, as walls are.
    if (random.index(3) > 0) {
        const Vec3<double> x = random.direction();
        const Vec3<double> y = normalize(cross(x, random.direction()));
        const Vec3<double> size{random.log_between(0.1, 1), random.log_between(0.1, 1), 1};
        const auto map = [&](const Vec3<double>& v) {
            return (size.x * v.x) * x + (size.y * v.y) * y + (size.z * v.z) * cross(x, y);
        };
        for (Vec3<double>& v : mesh.vertices) v = map(v);
        mesh.inside = map(mesh.inside);
    }

    // Moves the point towards the surface, but not so close that rounding could move it to the other side.
    const Vec3<double> towards = random.direction();
    const double share = random.index(2) == 0 ? random.uniform() : 1 - random.log_between(1e-3, 1);
    Vec3<double> point = mesh.inside;
    const double reach = detail::distance_to_surface(mesh, towards);
    if (reach < 100) point = point + (0.999 * share * reach) * towards;

    double radius = 0;
    for (const Vec3<double>& v : mesh.vertices) radius = std::max(radius, length(v - point));
    const double distance = radius * (1 + random.log_between(0.02, 1000));
    const double room = distance - 1.01 * radius;
    const Vec3<double> axis = random.index(3) == 0 ? Vec3<double>{0, 0, 1} : random.direction();
    const Vec3<double> side = normalize(cross(axis, random.direction()));
    // Every light in this ball is outside the mesh, and so is every light in the plane through its centre across the
    // axis.
    const bool is_tilted = random.index(2) == 0;
    const double size =
        is_tilted ? room * random.log_between(1e-4, 0.7) : radius * random.log_between(1e-4, 1e2);
    const Vec3<double> other = is_tilted ? normalize(cross(side, random.direction())) : cross(axis, side);
    const Vec3<double> center = point + distance * axis;

    const double unit = random.index(2) == 0 ? 1 : random.log_between(1e-3, 1e3);
    const Vec3<double> shift =
        random.index(2) == 0 ? Vec3<double>{0, 0, 0} : (5 * radius) * random.direction();
    const auto place = [&](float(&target)[3], const Vec3<double>& v) {
        detail::round_to(target, unit * (v + shift));
    };
    ShadowCase result;
    place(result.point, point);
    storage.clear();
    for (const auto& triangle : mesh.triangles) {
        Occluder occluder;
        for (int k = 0; k < 3; ++k) place(occluder.corner[k], mesh.vertices[triangle[k]]);
        storage.push_back(occluder);
    }
    result.occluders = storage.data();
    result.occluder_count = static_cast<int>(storage.size());
    for (int i = 0; i < 4; ++i) {
        const double x = i == 1 || i == 2 ? 0.7 : -0.7, y = i >= 2 ? 0.7 : -0.7;
        place(result.light[i], center + (size * x) * side + (size * y) * other);
    }
    result.angle = random.index(4) == 0 ? 0 : static_cast<float>(random.between(0, kPi<double>));
    for (int i = 0; i < kLinesPerCase; ++i) {
        result.u[i] = std::min(static_cast<float>(random.uniform()), 1 - 0x1p-24f);
        result.corner[i] = random.index(4) == 0 ? random.index(3 * result.occluder_count) : -1;
    }
    return result;
}

/// Lights, points and occluders that are degenerate, in contact, coplanar, tiny or huge.
/// \param index   of the case; cases depend on it and the seed only.
/// \param storage of the occluders, to which the result points.
inline ShadowCase make_hostile_case(std::uint64_t seed, std::uint64_t index, std::vector<Occluder>& storage) {
    hostile::HostileLights<float> lights(seed, index);
    hostile::RandomSource random(~seed, index);
    const ConvexPolygon<float, 4> light = lights.polygon();
    Vec3<float> point{0, 0, 0};
    const auto on_light = [&] {
        const int vertex = random.index(4);
        if (random.index(3) == 0) return light.vertex[vertex];
        // Somewhere on an edge, or anywhere in the plane.
        const auto share = [&] { return static_cast<float>(random.between(-0.5, 1.5)); };
        const Vec3<float> on_edge = fma(share(), light.edge[vertex], light.vertex[vertex]);
        if (random.index(2) == 0) return on_edge;
        return fma(share(), light.edge[vertex == 3 ? 0 : vertex + 1], on_edge);
    };
    if (random.index(8) == 0) point = on_light();
    const auto corner = [&]() -> Vec3<float> {
        const Vec3<float> to_light = on_light() - point;
        switch (random.index(8)) {
        case 0:
            return point;
        case 1:
            return point + to_light;
        case 2: // almost the point, or the light
            return fma(static_cast<float>(random.log_between(1e-9, 1)), to_light, point);
        case 3:
            return fma(static_cast<float>(1 - random.log_between(1e-9, 1)), to_light, point);
        case 4: // behind one of them
            return fma(static_cast<float>(random.between(-1, 2)), to_light, point);
        case 5: {
            const auto coordinate = [&] {
                const double x = random.log_between(1e-20, 1e15);
                return static_cast<float>(random.index(2) == 0 ? x : -x);
            };
            return {coordinate(), coordinate(), coordinate()};
        }
        default: {
            const double size = static_cast<double>(length(to_light)) * random.log_between(1e-3, 10);
            const Vec3<double> v = size * random.direction();
            return point +
                   Vec3<float>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        }
        }
    };
    const auto store = [](float(&target)[3], const Vec3<float>& v) {
        target[0] = v.x;
        target[1] = v.y;
        target[2] = v.z;
    };
    ShadowCase result;
    store(result.point, point);
    for (int j = 0; j < 4; ++j) store(result.light[j], light.vertex[j]);
    storage.resize(static_cast<std::size_t>(1 + random.index(24)));
    Vec3<float> shared = corner();
    for (Occluder& occluder : storage) {
        const Vec3<float> a = random.index(2) == 0 ? shared : corner();
        shared = corner();
        const Vec3<float> c = random.index(16) == 0 ? a : corner();
        store(occluder.corner[0], a);
        store(occluder.corner[1], shared);
        store(occluder.corner[2], c);
    }
    result.occluders = storage.data();
    result.occluder_count = static_cast<int>(storage.size());
    result.angle = random.index(4) == 0 ? 0 : static_cast<float>(random.between(0, 3.14));
    for (int i = 0; i < kLinesPerCase; ++i) {
        result.u[i] = lights.random_number();
        result.corner[i] = random.index(8) == 0 ? random.index(3 * result.occluder_count) : -1;
    }
    return result;
}

} // namespace shadows
NUSSELT_NAMESPACE_END
