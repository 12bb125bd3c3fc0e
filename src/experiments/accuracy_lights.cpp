#include "experiments/accuracy_lights.h"

#include <cmath>
#include <numbers>

namespace nusselt::experiments {

namespace {

using Vec = Vec3<double>;

double uniform(Engine& engine, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
}

Vec direction(Engine& engine) {
    std::normal_distribution<double> normal;
    Vec v{normal(engine), normal(engine), normal(engine)};
    return normalize(v);
}

/// A unit vector at the given height, in a random azimuth.
Vec at_height(Engine& engine, double z) {
    const double azimuth = uniform(engine, 0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

Vec3<float> to_float(const Vec& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// The polygon with vertex 0 at `first` and these edges, rounded to float. Positions follow from the edges.
ConvexPolygon<float, 4> from_edges(const Vec& first, const Vec (&edges)[3]) {
    ConvexPolygon<float, 4> polygon;
    polygon.vertex[0] = to_float(first);
    Vec3<float> sum{0, 0, 0};
    for (int j = 0; j < 3; ++j) {
        polygon.edge[j] = to_float(edges[j]);
        polygon.vertex[j + 1] = polygon.vertex[j] + polygon.edge[j];
        sum = sum + polygon.edge[j];
    }
    polygon.edge[3] = -sum;
    polygon.normal = normalize(doubled_area_normal(polygon));
    return polygon;
}

/// A rectangle with the given centre, half sides a and b, beginning at a random corner.
ConvexPolygon<float, 4> rectangle(Engine& engine, const Vec& centre, Vec a, Vec b) {
    const int turns = std::uniform_int_distribution<int>(0, 3)(engine);
    for (int i = 0; i < turns; ++i) {
        const Vec turned = -b;
        b = a;
        a = turned;
    }
    return from_edges(centre - a - b, {2.0 * a, 2.0 * b, -2.0 * a});
}

struct Sides {
    Vec a, b;
};

/// Orthogonal vectors of random orientation and these lengths.
Sides random_sides(Engine& engine, double a_length, double b_length) {
    const Vec a = direction(engine);
    const Vec b = normalize(cross(a, direction(engine)));
    return {a_length * a, b_length * b};
}

ConvexPolygon<float, 4> random_rectangle(Engine& engine, const Vec& centre, double half_side) {
    const Sides s = random_sides(engine, half_side, half_side * uniform(engine, 0.5, 1));
    return rectangle(engine, centre, s.a, s.b);
}

ConvexPolygon<float, 4> small_square(Engine& engine, double side) {
    const Sides s = random_sides(engine, side / 2, side / 2);
    return rectangle(engine, 40.0 * at_height(engine, uniform(engine, 0.05, 0.99)), s.a, s.b);
}

/// A unit square whose plane passes the origin at a distance of 1e-3.
ConvexPolygon<float, 4> close_square(Engine& engine, double centre_low, double centre_high) {
    const Sides s = random_sides(engine, 0.5, 0.5);
    const Vec normal = 2.0 * cross(s.a, s.b);
    const Vec along =
        uniform(engine, centre_low, centre_high) * (2.0 * s.a) + uniform(engine, -0.4, 0.4) * (2.0 * s.b);
    const double side = normal.z < 0 ? -1 : 1;
    return rectangle(engine, along + (1e-3 * side / length(normal)) * normal, s.a, s.b);
}

LineSegment<float> line(const Vec& begin, const Vec& end) {
    const LineSegment<double> exact = make_line(begin, end);
    return {to_float(exact.p0), to_float(exact.s), static_cast<float>(exact.length)};
}

LineSegment<float> line_around(Engine& engine, const Vec& centre, double half_length) {
    const Vec half = half_length * direction(engine);
    return line(centre - half, centre + half);
}

} // namespace

const std::vector<PolygonClass>& polygon_classes() {
    static const std::vector<PolygonClass> classes{
        {"decentral", [](Engine& e) { return random_rectangle(e, at_height(e, uniform(e, 0.5, 0.7)), 0.3); }},
        {"central",
         [](Engine& e) {
             const Vec a = at_height(e, 0);
             return rectangle(e, {uniform(e, -0.2, 0.2), uniform(e, -0.2, 0.2), 1}, 0.5 * a,
                              0.5 * Vec{-a.y, a.x, 0});
         }},
        {"crossing the horizon",
         [](Engine& e) { return random_rectangle(e, at_height(e, uniform(e, -0.1, 0.1)), 0.4); }},
        {"square of 1 cm at 40 m", [](Engine& e) { return small_square(e, 0.01); }},
        {"square of 1 mm at 40 m", [](Engine& e) { return small_square(e, 0.001); }},
        {"close to the interior, 1e-3 of the size", [](Engine& e) { return close_square(e, -0.4, 0.4); }},
        {"close to the plane, beside the light", [](Engine& e) { return close_square(e, 0.6, 1.5); }},
        {"edge in a vertical plane through the point",
         [](Engine& e) {
             // The first edge keeps its azimuth exactly: twice or half the vertex in x and y.
             const Vec first = at_height(e, uniform(e, 0.2, 0.8));
             const Vec3<float> f = to_float(first);
             const double stretch = uniform(e, 0, 1) < 0.5 ? 1.0 : -0.5;
             const Vec edge{stretch * f.x, stretch * f.y, uniform(e, -0.3, 0.3)};
             const Vec side = uniform(e, 0.2, 1) * normalize(cross(edge, direction(e)));
             return from_edges(first, {edge, side, -edge});
         }},
        {"repeated vertex",
         [](Engine& e) {
             const Sides s = random_sides(e, 0.5, 0.4);
             const Vec first = at_height(e, uniform(e, 0.3, 0.8));
             return from_edges(first, {s.a, Vec{0, 0, 0}, s.b});
         }},
    };
    return classes;
}

const std::vector<LineClass>& line_classes() {
    static const std::vector<LineClass> classes{
        {"ordinary", [](Engine& e) { return line_around(e, at_height(e, uniform(e, 0.5, 0.9)), 0.4); }},
        {"crossing the horizon",
         [](Engine& e) { return line_around(e, at_height(e, uniform(e, -0.1, 0.1)), 0.4); }},
        {"1 cm at 40 m",
         [](Engine& e) { return line_around(e, 40.0 * at_height(e, uniform(e, 0.05, 0.99)), 0.005); }},
        {"1 mm at 40 m",
         [](Engine& e) { return line_around(e, 40.0 * at_height(e, uniform(e, 0.05, 0.99)), 0.0005); }},
        {"1e-3 of the length beside it",
         [](Engine& e) {
             const Vec s = direction(e);
             Vec off = normalize(cross(s, direction(e)));
             off = (off.z < 0 ? -1e-3 : 1e-3) * off;
             const double begin = -uniform(e, 0.1, 0.9);
             return line(begin * s + off, (begin + 1) * s + off);
         }},
        {"1e-3 of the length beyond an end",
         [](Engine& e) {
             Vec s = direction(e);
             if (s.z < 0) s = -s;
             const Vec off = 1e-3 * normalize(cross(s, direction(e)));
             return line(1e-3 * s + off, 1.001 * s + off);
         }},
        {"pointing at the point within 1e-4",
         [](Engine& e) {
             const Vec s = at_height(e, uniform(e, 0.1, 0.95));
             const Vec tilted = normalize(s + uniform(e, 0, 1e-4) * direction(e));
             return line(s, s + tilted);
         }},
        {"in the horizon plane",
         [](Engine& e) {
             return line({uniform(e, 0.5, 1), -1, 0}, {uniform(e, 0.5, 1), uniform(e, 0, 1), 0});
         }},
    };
    return classes;
}

} // namespace nusselt::experiments
