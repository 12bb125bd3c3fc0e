#pragma once
/// Hostile lights and random numbers for each kind of technique.

#include "proof/hostile/lights.h"
#include "proof/techniques/registry.h"

namespace nusselt::parity {

inline void draw(hostile::HostileLights<float>& source, LineSegment<float>& light, float& u) {
    light = source.line();
    u = source.random_number();
}

inline void draw(hostile::HostileLights<float>& source, Cylinder<float>& light, Vec2<float>& u) {
    light = source.cylinder();
    u.x = source.random_number();
    u.y = source.random_number();
}

template <int N>
void draw(hostile::HostileLights<float>& source, ConvexPolygon<float, N>& light, Vec2<float>& u) {
    if constexpr (N == 3) {
        Vec3<float> v[4] = {}; // the fewest that vertices() makes
        source.vertices<4>(v);
        const Vec3<float> corners[3] = {v[0], v[1], v[2]};
        light = make_polygon<3>(corners, 3);
    } else {
        light = source.polygon<N>();
    }
    u.x = source.random_number();
    u.y = source.random_number();
}

template <template <class> class Shape>
void draw(hostile::HostileLights<float>& source, Shape<float>& light, Vec2<float>& u) {
    light = hostile::RoundKind<Shape>::from(source.ellipsoid());
    u.x = source.random_number();
    u.y = source.random_number();
}
template <template <class> class Shape>
void draw(hostile::HostileLights<float>& source, hostile::RoundOnLobe<float, Shape>& light, Vec2<float>& u) {
    draw(source, static_cast<Shape<float>&>(light), u);
    light.lobe = source.lobe();
}

template <int N>
void draw(hostile::HostileLights<float>& source, hostile::PolygonOnLobe<float, N>& light, Vec2<float>& u) {
    draw(source, static_cast<ConvexPolygon<float, N>&>(light), u);
    light.lobe = source.lobe();
}
inline void draw(hostile::HostileLights<float>& source, hostile::LineOnLobe<float>& light, float& u) {
    draw(source, static_cast<LineSegment<float>&>(light), u);
    light.lobe = source.lobe();
}
inline void draw(hostile::HostileLights<float>& source, hostile::CylinderOnLobe<float>& light,
                 Vec2<float>& u) {
    draw(source, static_cast<Cylinder<float>&>(light), u);
    light.lobe = source.lobe();
}

} // namespace nusselt::parity
