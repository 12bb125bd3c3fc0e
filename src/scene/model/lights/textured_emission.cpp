#include "scene/model/lights/textured_emission.h"

#include "scene/model/vector_math.h"

#include <cmath>
#include <cstddef>

namespace nusselt::scene {

namespace {

/// Twice the signed area of a triangle of texture coordinates.
double doubled_area(const Float2& a, const Float2& b, const Float2& c) {
    return (double{b.x} - a.x) * (double{c.y} - a.y) - (double{b.y} - a.y) * (double{c.x} - a.x);
}

} // namespace

TexturePlacement place_texture(const PolygonLight& light, const TexturedEmission& emission) {
    // The corners of the largest triangle determine the map with the smallest error of rounding.
    const auto& at = emission.coordinates;
    std::size_t i = 0, j = 1, k = 2;
    for (std::size_t a = 0; a < light.vertices.size(); ++a)
        for (std::size_t b = a + 1; b < light.vertices.size(); ++b)
            for (std::size_t c = b + 1; c < light.vertices.size(); ++c)
                if (std::fabs(doubled_area(at[a], at[b], at[c])) >
                    std::fabs(doubled_area(at[i], at[j], at[k])))
                    i = a, j = b, k = c;
    const Double3 origin = to_double(light.vertices[i]);
    const Double3 first = to_double(light.vertices[j]) - origin;
    const Double3 second = to_double(light.vertices[k]) - origin;
    const double inverse = 1 / doubled_area(at[i], at[j], at[k]);
    const Double3 side_x =
        inverse * ((double{at[k].y} - at[i].y) * first - (double{at[j].y} - at[i].y) * second);
    const Double3 side_y =
        inverse * ((double{at[j].x} - at[i].x) * second - (double{at[k].x} - at[i].x) * first);
    const Double3 corner = origin - double{at[i].x} * side_x - double{at[i].y} * side_y;
    return {to_float(corner), to_float(side_x), to_float(side_y)};
}

Float3 texel_scale(const PolygonLight& light, const TexturedEmission& emission) {
    return per_channel_ratio(light.radiance, emission.mean);
}

} // namespace nusselt::scene
