#include "proof/accuracy/lights.h"

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <utility>

namespace nusselt::proof {

namespace {

// Random numbers are drawn in separate statements or as elements in braces. Compilers may evaluate operands and
// arguments in any order, but all of them must make the same lights.

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

/// The polygon with vertex 0 at `first`, with these edges, rounded to float, and one more edge that closes it.
PolygonLight from_edges(const Vec& first, std::initializer_list<Vec> edges) {
    PolygonLight polygon{to_float(first), {}, 1};
    for (const Vec& edge : edges) polygon.edge[polygon.count++ - 1] = to_float(edge);
    return polygon;
}

/// A rectangle with the given centre and half sides a and b. Its first vertex is a random corner.
PolygonLight rectangle(Engine& engine, const Vec& centre, Vec a, Vec b) {
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

/// Orthogonal vectors with random orientation and these lengths.
Sides random_sides(Engine& engine, double a_length, double b_length) {
    const Vec a = direction(engine);
    const Vec b = normalize(cross(a, direction(engine)));
    return {a_length * a, b_length * b};
}

PolygonLight random_rectangle(Engine& engine, const Vec& centre, double half_side) {
    const Sides s = random_sides(engine, half_side, half_side * uniform(engine, 0.5, 1));
    return rectangle(engine, centre, s.a, s.b);
}

PolygonLight small_square(Engine& engine, double side) {
    const Sides s = random_sides(engine, side / 2, side / 2);
    return rectangle(engine, 40.0 * at_height(engine, uniform(engine, 0.05, 0.99)), s.a, s.b);
}

/// A unit square whose plane passes the origin at a distance of 1e-3.
PolygonLight close_square(Engine& engine, double centre_low, double centre_high) {
    const Sides s = random_sides(engine, 0.5, 0.5);
    const Vec normal = 2.0 * cross(s.a, s.b);
    const double along_a = uniform(engine, centre_low, centre_high);
    const double along_b = uniform(engine, -0.4, 0.4);
    const Vec along = along_a * (2.0 * s.a) + along_b * (2.0 * s.b);
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

/// Rounds a vector to multiples of 2^-18. Sums of a few such vectors are exact in float.
Vec with_few_bits(const Vec& v) {
    constexpr double kUnit = 1.0 / (1 << 18);
    return {kUnit * std::round(v.x / kUnit), kUnit * std::round(v.y / kUnit),
            kUnit * std::round(v.z / kUnit)};
}

/// An exactly planar polygon: its vertices are images of some corners of an octagon with integer coordinates.
PolygonLight decentral_polygon(Engine& engine, int count) {
    constexpr int kOctagon[8][2] = {{-1, -3}, {1, -3}, {3, -1}, {3, 1}, {1, 3}, {-1, 3}, {-3, 1}, {-3, -1}};
    const Vec centre = with_few_bits(at_height(engine, uniform(engine, 0.5, 0.7)));
    const Sides s = random_sides(engine, 0.1, 0.1);
    const Vec a = with_few_bits(s.a);
    const Vec b = with_few_bits(s.b);
    const auto corner = [&](int j) {
        const int* c = kOctagon[j * 8 / count];
        return centre + static_cast<double>(c[0]) * a + static_cast<double>(c[1]) * b;
    };
    PolygonLight polygon{to_float(corner(0)), {}, count};
    for (int j = 0; j + 1 < count; ++j) polygon.edge[j] = to_float(corner(j + 1) - corner(j));
    return polygon;
}

PolygonLight triangle(Engine& engine) {
    const Sides s = random_sides(engine, 0.5, 0.4);
    return from_edges(at_height(engine, uniform(engine, 0.3, 0.8)), {s.a, s.b});
}

/// A polygon whose vertices are exactly on one line.
PolygonLight without_area(Engine& engine) {
    const Vec first = at_height(engine, uniform(engine, 0.3, 0.8));
    const Vec3<float> rounded = to_float(0.3 * direction(engine));
    const Vec a{rounded.x, rounded.y, rounded.z};
    const Vec zero{0, 0, 0};
    switch (std::uniform_int_distribution<int>(0, 2)(engine)) {
    case 0:
        return from_edges(first, {a, zero, -a});
    case 1:
        return from_edges(first, {zero, zero, zero});
    default:
        return from_edges(first, {a, 0.5 * a, -a});
    }
}

/// A parallelogram in a plane through the origin. Its vertices are combinations of two integer vectors.
PolygonLight edge_on(Engine& engine) {
    const auto integer = [&](int low) {
        return static_cast<double>(std::uniform_int_distribution<int>(low, 15)(engine)) / 16;
    };
    const Vec a{integer(-15), integer(-15), integer(1)};
    const Vec b{integer(-15), integer(-15), integer(1)};
    return from_edges(2.0 * a + b, {a, b, -a});
}

PolygonLight below_horizon(Engine& engine) {
    if (uniform(engine, 0, 1) < 0.5) return random_rectangle(engine, at_height(engine, -0.5), 0.3);
    const Vec first = at_height(engine, 0);
    const double width = uniform(engine, 0.2, 1);
    const Vec along = width * at_height(engine, 0);
    const Vec down = at_height(engine, -0.4);
    return from_edges(first, {along, down, -along});
}

} // namespace

const std::vector<PolygonClass>& polygon_classes() {
    static const std::vector<PolygonClass> classes{
        {"decentral", Visibility::everyone, 4,
         [](Engine& e) { return random_rectangle(e, at_height(e, uniform(e, 0.5, 0.7)), 0.3); }},
        {"central", Visibility::everyone, 4,
         [](Engine& e) {
             const Vec a = at_height(e, 0);
             return rectangle(e, {uniform(e, -0.2, 0.2), uniform(e, -0.2, 0.2), 1}, 0.5 * a,
                              0.5 * Vec{-a.y, a.x, 0});
         }},
        {"crossing the horizon", Visibility::everyone, 4,
         [](Engine& e) { return random_rectangle(e, at_height(e, uniform(e, -0.1, 0.1)), 0.4); }},
        {"square of 1 cm at 40 m", Visibility::everyone, 4, [](Engine& e) { return small_square(e, 0.01); }},
        {"square of 1 mm at 40 m", Visibility::everyone, 4, [](Engine& e) { return small_square(e, 0.001); }},
        {"close to the interior, 1e-3 of the size", Visibility::everyone, 4,
         [](Engine& e) { return close_square(e, -0.4, 0.4); }},
        {"close to the plane, beside the light", Visibility::everyone, 4,
         [](Engine& e) { return close_square(e, 0.6, 1.5); }},
        {"edge in a vertical plane through the point", Visibility::everyone, 4,
         [](Engine& e) {
             // The ends of the first edge have exactly the same azimuth: x and y of one are twice or half those of
             // the other.
             const Vec first = at_height(e, uniform(e, 0.2, 0.8));
             const Vec3<float> f = to_float(first);
             const double stretch = uniform(e, 0, 1) < 0.5 ? 1.0 : -0.5;
             const Vec edge{stretch * f.x, stretch * f.y, uniform(e, -0.3, 0.3)};
             const double width = uniform(e, 0.2, 1);
             const Vec side = width * normalize(cross(edge, direction(e)));
             return from_edges(first, {edge, side, -edge});
         }},
        {"triangle", Visibility::everyone, 3, triangle},
        {"triangle with a repeated vertex", Visibility::everyone, 4,
         [](Engine& e) {
             PolygonLight polygon = triangle(e);
             const int position = std::uniform_int_distribution<int>(0, 2)(e);
             for (int j = 2; j > position; --j) std::swap(polygon.edge[j], polygon.edge[j - 1]);
             polygon.count = 4;
             return polygon;
         }},
        {"decentral, 3 vertices", Visibility::everyone, 3, [](Engine& e) { return decentral_polygon(e, 3); }},
        {"decentral, 5 vertices", Visibility::everyone, 5, [](Engine& e) { return decentral_polygon(e, 5); }},
        {"decentral, 6 vertices", Visibility::everyone, 6, [](Engine& e) { return decentral_polygon(e, 6); }},
        {"decentral, 7 vertices", Visibility::everyone, 7, [](Engine& e) { return decentral_polygon(e, 7); }},
        {"decentral, 8 vertices", Visibility::everyone, 8, [](Engine& e) { return decentral_polygon(e, 8); }},
        {"no area", Visibility::no_one, 4, without_area},
        {"edge-on", Visibility::no_one, 4, edge_on},
        {"below the horizon", Visibility::no_one_above_horizon, 4, below_horizon},
    };
    return classes;
}

const std::vector<LineClass>& line_classes() {
    static const std::vector<LineClass> classes{
        {"ordinary", Visibility::everyone,
         [](Engine& e) { return line_around(e, at_height(e, uniform(e, 0.5, 0.9)), 0.4); }},
        {"crossing the horizon", Visibility::everyone,
         [](Engine& e) { return line_around(e, at_height(e, uniform(e, -0.1, 0.1)), 0.4); }},
        {"1 cm at 40 m", Visibility::everyone,
         [](Engine& e) { return line_around(e, 40.0 * at_height(e, uniform(e, 0.05, 0.99)), 0.005); }},
        {"1 mm at 40 m", Visibility::everyone,
         [](Engine& e) { return line_around(e, 40.0 * at_height(e, uniform(e, 0.05, 0.99)), 0.0005); }},
        {"1e-3 of the length beside it", Visibility::everyone,
         [](Engine& e) {
             const Vec s = direction(e);
             Vec off = normalize(cross(s, direction(e)));
             off = (off.z < 0 ? -1e-3 : 1e-3) * off;
             const double begin = -uniform(e, 0.1, 0.9);
             return line(begin * s + off, (begin + 1) * s + off);
         }},
        {"1e-3 of the length beyond an end", Visibility::everyone,
         [](Engine& e) {
             Vec s = direction(e);
             if (s.z < 0) s = -s;
             const Vec off = 1e-3 * normalize(cross(s, direction(e)));
             return line(1e-3 * s + off, 1.001 * s + off);
         }},
        {"pointing at the point within 1e-4", Visibility::everyone,
         [](Engine& e) {
             const Vec s = at_height(e, uniform(e, 0.1, 0.95));
             const double tilt = uniform(e, 0, 1e-4);
             const Vec tilted = normalize(s + tilt * direction(e));
             return line(s, s + tilted);
         }},
        {"in the horizon plane", Visibility::no_one_above_horizon,
         [](Engine& e) {
             const Vec begin{uniform(e, 0.5, 1), -1, 0};
             const Vec end{uniform(e, 0.5, 1), uniform(e, 0, 1), 0};
             return line(begin, end);
         }},
        {"below the horizon", Visibility::no_one_above_horizon,
         [](Engine& e) { return line_around(e, at_height(e, -0.5), 0.4); }},
        {"along an axis through the point", Visibility::no_one,
         [](Engine& e) {
             // These are the only directions that have length 1 in every number type.
             const Vec axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
             const Vec& s = axes[std::uniform_int_distribution<int>(0, 2)(e)];
             const double begin = uniform(e, 0.1, 1);
             return line(begin * s, (begin + uniform(e, 0.1, 1)) * s);
         }},
    };
    return classes;
}

} // namespace nusselt::proof
