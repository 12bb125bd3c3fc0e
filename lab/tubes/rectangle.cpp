#include "lab/tubes/rectangle.h"

#include "scene/model/lights/light_geometry.h"

namespace nusselt::lab {

scene::PolygonLight rectangle_of(const scene::LineLight& strip) {
    scene::LightMesh mesh;
    scene::LightKind<scene::LineLight>::add_mesh(strip, mesh);
    scene::PolygonLight rectangle;
    rectangle.emitter = strip.emitter;
    for (const scene::Float3& corner : mesh.positions) rectangle.vertices.push_back(corner);
    rectangle.radiance = strip.radiance;
    rectangle.two_sided = true;
    return rectangle;
}

} // namespace nusselt::lab
