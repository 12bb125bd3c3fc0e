#include "scene/build/lights/dark_portals.h"

#include "scene/model/bounds.h"
#include "scene/model/lights/environment_light.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/octahedral_map.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace nusselt::scene {

namespace {

/// A plane. Its sides are those before it, from which the normal leads away, and those beyond it.
struct PortalPlane {
    Double3 origin, normal;
};

/// A flag for each side of the plane of a portal.
struct Sides {
    bool before = false, beyond = false;
};

PortalPlane plane_of(const PolygonVertices& portal) {
    const Double3 origin = to_double(portal[0]);
    Double3 sum;
    for (std::size_t i = 2; i < portal.size(); ++i)
        sum = sum + cross(to_double(portal[i - 1]) - origin, to_double(portal[i]) - origin);
    return {origin, normalized(sum)};
}

/// On which sides surfaces are. Boxes stand for instances.
Sides surface_sides(const Scene& scene, const PortalPlane& plane) {
    // Walls around a window are in its plane, but for rounding.
    const double rounding = 1e-5 * scene.radius;
    Sides sides;
    const auto add = [&](const Double3& p) {
        const double height = dot(plane.normal, p - plane.origin);
        sides.before |= height < -rounding;
        sides.beyond |= height > rounding;
    };
    for (std::size_t i = 0; i < world_triangle_count(scene); ++i)
        for (const std::uint32_t vertex : scene.triangles[i].vertex) add(to_double(scene.positions[vertex]));
    for (const Instance& instance : scene.instances) {
        const Object& object = scene.objects[instance.object];
        const Bounds box = transformed(triangle_bounds(scene, object.first_triangle, object.triangle_count),
                                       instance.world_from_object);
        for (const double x : {box.low.x, box.high.x})
            for (const double y : {box.low.y, box.high.y})
                for (const double z : {box.low.z, box.high.z}) add({x, y, z});
    }
    return sides;
}

/// From which sides light comes.
Sides lit_sides(const Scene& scene, const EnvironmentLight& light, const PortalPlane& plane) {
    if (light.map < 0) return {true, true};
    const EnvironmentMapTexels& map = *scene.environment_maps[static_cast<std::size_t>(light.map)];
    const auto along = [&](const Float3& axis) { return dot(to_double(axis), plane.normal); };
    const Double3 normal = {along(light.x_axis), along(light.y_axis), along(light.z_axis)};
    double before = 0;
    double beyond = 0;
    std::size_t index = 0;
    for (int j = 0; j < map.size; ++j) {
        for (int i = 0; i < map.size; ++i, ++index) {
            const Float3& texel = map.texels[index];
            const Vec3<double> d =
                octahedral_direction(Vec2<double>{(i + 0.5) / map.size, (j + 0.5) / map.size});
            const double cosine = dot(normal, {d.x, d.y, d.z});
            (cosine < 0 ? before : beyond) += std::fabs(cosine) * (texel.x + texel.y + texel.z);
        }
    }
    // A sky that ends at the plane lights texels across it.
    const double least = 8 / (static_cast<double>(map.size) * map.size) * (before + beyond);
    return {before > least, beyond > least};
}

} // namespace

std::vector<EmitterOrigin> environment_origins(const BuiltShape& shapes) {
    std::vector<EmitterOrigin> origins;
    for (const EnvironmentLight& light : shapes.lights.of<EnvironmentLight>())
        origins.push_back(shapes.emitters[light.emitter]);
    return origins;
}

Darkness DarkPortals::of(const EnvironmentLight& light) {
    if (light.portal.size() == 0 || world_triangle_count(scene_) + scene_.instances.size() == 0)
        return std::nullopt;
    const std::string clause = "no surface receives light through its portal, because ";
    const PortalPlane plane = plane_of(light.portal);
    const Sides surfaces = surface_sides(scene_, plane);
    if (!surfaces.before && !surfaces.beyond) return clause + "all of them are in the plane of the portal";
    const Sides lit = lit_sides(scene_, light, plane);
    if (!(surfaces.before && lit.beyond) && !(surfaces.beyond && lit.before))
        return clause + "the environment is black on the side without surfaces";
    if (!view_) view_.emplace(scene_);
    const auto arrives = [&](const Double3& direction) {
        return dot(plane.normal, direction) > 0 ? lit.beyond : lit.before;
    };
    if (view_->receives_light(light.portal, arrives)) return std::nullopt;
    return "nothing that the camera sees receives light through its portal; a wall may hide it";
}

void warn_of_dark_portals(const Scene& scene, const std::vector<EmitterOrigin>& origins, Warnings& warnings) {
    const auto& lights = scene.lights.of<EnvironmentLight>();
    DarkPortals portals(scene);
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (const Darkness darkness = portals.of(lights[i]))
            warn_of_darkness(origins[i].location, std::string(origins[i].kind), *darkness, warnings);
}

} // namespace nusselt::scene
