#pragma once
/// Seeded generators of lights that tend to break samplers. All of them are valid input.
///
/// Shared by the unit tests and `nusselt-lab fuzz`.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <nusselt/cones/round_lights.h>
#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/cylinder.h>
#include <nusselt/geometry/line_segment.h>
#include <nusselt/ltc/coefficients.h>

NUSSELT_NAMESPACE_BEGIN
namespace hostile {

/// SplitMix64 of G. Steele, D. Lea, C. Flood 2014, Fast Splittable Pseudorandom Number Generators, OOPSLA. Each pair
/// of seed and index has a separate stream. Nothing depends on the standard library's distributions.
class RandomSource {
public:
    explicit RandomSource(std::uint64_t seed, std::uint64_t index = 0) : state_(mix(mix(seed) + index)) {}

    double uniform() {
        state_ += 0x9e3779b97f4a7c15u;
        return static_cast<double>(mix(state_) >> 11) * 0x1p-53;
    }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    double log_between(double low, double high) { return low * std::exp(std::log(high / low) * uniform()); }
    int index(int count) { return static_cast<int>(uniform() * count); }
    Vec3<double> direction() {
        for (;;) {
            const double x = between(-1, 1);
            const double y = between(-1, 1);
            const double z = between(-1, 1);
            const double squared = x * x + y * y + z * z;
            if (squared > 1 || squared < 1e-4) continue;
            const double scale = 1 / std::sqrt(squared);
            return {scale * x, scale * y, scale * z};
        }
    }

private:
    static std::uint64_t mix(std::uint64_t x) {
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }

    std::uint64_t state_;
};

/// Hostile lights with coordinates of type T. A seed and index always give the same lights.
template <class T>
class HostileLights {
    using Vec = Vec3<double>;

public:
    explicit HostileLights(std::uint64_t seed, std::uint64_t index = 0) : random_(seed, index) {}

    /// A random number in [0, 1), often 0, the largest number below 1, a tiny number or a denormal one.
    T random_number() {
        switch (random_.index(8)) {
        case 0:
            return random_.index(4) == 0 ? static_cast<T>(kSmallest * random_.log_between(1, 1e6)) : T(0);
        case 1:
            return kLargestBelowOne;
        case 2:
            return static_cast<T>(random_.log_between(1e-9, 1));
        case 3:
            return std::min(static_cast<T>(1 - random_.log_between(1e-9, 1)), kLargestBelowOne);
        default:
            return std::min(static_cast<T>(random_.uniform()), kLargestBelowOne);
        }
    }

    /// The vertices of a polygon in either winding.
    /// \returns their number, 3 to N
    template <int N>
    int vertices(Vec3<T> (&result)[N]) {
        static_assert(4 <= N && N <= kMaxVertices);
        Vertices v = random_.index(10) == 0 ? integer_quad() : round_polygon(N);
        const int changes = random_.index(3);
        for (int i = 0; i < changes; ++i) deform(v);
        if (random_.index(2) == 0) std::reverse(v.at, v.at + v.count);
        const double unit = unit_of_length();
        for (int j = 0; j < v.count; ++j) result[j] = rounded(v.at[j], unit);
        return v.count;
    }
    template <int N = 4>
    ConvexPolygon<T, N> polygon() {
        Vec3<T> v[N] = {};
        const int count = vertices<N>(v);
        return make_polygon<N>(v, count);
    }

    /// The start and the end of a line.
    void ends(Vec3<T> (&result)[2]) {
        const Vec middle = random_.direction();
        const Vec half = random_.log_between(1e-6, 1e6) * random_.direction();
        Vec begin = middle - half;
        Vec end = middle + half;
        deform(begin, end);
        if (random_.index(2) == 0) std::swap(begin, end);
        const double unit = unit_of_length();
        result[0] = rounded(begin, unit);
        result[1] = rounded(end, unit);
    }
    LineSegment<T> line() {
        Vec3<T> v[2];
        ends(v);
        return make_line(v[0], v[1]);
    }

    /// The radius of a cylinder with this axis: thin or thick, or with the point almost on its surface.
    T radius(const Vec3<T> (&ends)[2]) {
        const Vec begin = broadcast<double>(ends[0]);
        const Vec axis = broadcast<double>(ends[1]) - begin;
        const double distance = length(cross(begin, normalize(axis)));
        const double extent = std::max(length(begin), length(axis));
        const int choice = random_.index(12);
        double radius = distance * random_.log_between(1e-6, 1);
        if (choice == 0) radius = distance;
        if (choice == 1) radius = distance * (1 - random_.log_between(1e-16, 1e-2));
        if (choice == 2) radius = distance * (1 + random_.log_between(1e-16, 1e-2));
        if (choice == 3) radius = extent * random_.between(0.1, 1);
        if (choice == 4) radius = extent * random_.log_between(1e-9, 1e3);
        if (choice == 5) radius = random_.index(2) == 0 ? 0 : kSmallest * random_.log_between(1, 1e9);
        // This is also the limit for the coordinates of the ends.
        return static_cast<T>(std::min(radius, 1e15));
    }
    Cylinder<T> cylinder() {
        Vec3<T> v[2];
        ends(v);
        return {make_line(v[0], v[1]), radius(v)};
    }

    /// The centre and the semi-diameters of an ellipsoid, from which other round lights are made.
    void semi_diameters(Vec3<T> (&result)[4]) {
        Vec v[4] = {random_.direction(), random_.direction(), random_.direction(), random_.direction()};
        Vec& center = v[0];
        if (random_.index(10) == 0) {
            for (Vec& x : v) x = integer_vector();
        } else {
            const double size = random_.log_between(1e-6, 1e6);
            const bool is_thin = random_.index(4) == 0;
            // Perpendicular, but for thin lights.
            v[2] = normalize(cross(v[1], v[2]));
            v[3] = cross(v[1], v[2]);
            for (int i = 1; i < 4; ++i)
                v[i] = (size * (is_thin ? random_.log_between(1e-8, 1) : random_.between(0.5, 1))) * v[i];
            if (is_thin) v[2] = v[2] + v[1];
        }
        for (int i = random_.index(3); i > 0; --i) deform(center, v);
        const double unit = unit_of_length();
        for (int j = 0; j < 4; ++j) result[j] = rounded(v[j], unit);
    }
    Ellipsoid<T> ellipsoid() {
        Vec3<T> v[4];
        semi_diameters(v);
        return {v[0], {v[1], v[2], v[3]}};
    }

    /// A lobe, from an almost perfect mirror to a Lambertian one, seen from any inclination up to the horizon.
    LtcCoefficients<T> lobe() {
        double tilt = random_.between(0, kTurn / 4);
        const int place = random_.index(6);
        if (place == 0) tilt = 0;
        if (place == 1) tilt = kTurn / 4 - random_.log_between(1e-9, 1e-1);
        const double width = random_.index(8) == 0 ? 1 : random_.log_between(2e-4, 1.2);
        const double aspect = random_.log_between(0.1, 2); // of the widths in the plane of wo and across it
        const double skew = random_.index(3) == 0 ? 0 : random_.between(-0.6, 0.6);
        const double scale = random_.index(4) == 0 ? random_.log_between(1e-3, 1e3) : 1;
        const double sine = std::sin(tilt);
        const double cosine = std::cos(tilt);
        return {static_cast<T>(scale * (cosine + skew * sine)),
                static_cast<T>(scale * (sine - skew * cosine)),
                static_cast<T>(scale * aspect),
                static_cast<T>(-scale * width * sine),
                static_cast<T>(scale * width * cosine),
                T(1)};
    }

private:
    static constexpr int kMaxVertices = 8;
    static constexpr double kTurn = 6.283185307179586;
    static constexpr T kLargestBelowOne = 1 - std::numeric_limits<T>::epsilon() / 2;
    /// The smallest positive number. Lights are computed in double, so its limits apply, too.
    static constexpr double kSmallest = std::max(static_cast<T>(std::numeric_limits<double>::denorm_min()),
                                                 std::numeric_limits<T>::denorm_min());

    struct Vertices {
        Vec at[kMaxVertices];
        int count = 0;
    };

    /// Mostly moderate, but sometimes coordinates become denormal or reach about 1e15.
    double unit_of_length() {
        constexpr double kSmallestNormal =
            std::max(static_cast<T>(std::numeric_limits<double>::min()), std::numeric_limits<T>::min());
        switch (random_.index(12)) {
        case 0:
            return 1e15 / 1e6;
        case 1:
            return kSmallestNormal * random_.log_between(1e-6, 1e3);
        case 2:
            return random_.log_between(1e-6, 1e6);
        default:
            return 1;
        }
    }

    static Vec3<T> rounded(const Vec& v, double unit) {
        return {static_cast<T>(unit * v.x), static_cast<T>(unit * v.y), static_cast<T>(unit * v.z)};
    }

    /// A polygon inscribed in an ellipse of random orientation, with any size relative to its distance.
    Vertices round_polygon(int largest_count) {
        const Vec center = random_.direction();
        const Vec a = random_.direction();
        const Vec b = normalize(cross(a, random_.direction()));
        const double size = random_.log_between(1e-6, 1e6);
        const double width = random_.index(4) == 0 ? random_.log_between(1e-8, 1) : 1;
        Vertices v;
        v.count = 3 + random_.index(largest_count - 2);
        const double start = random_.between(0, kTurn);
        for (int j = 0; j < v.count; ++j) {
            const double angle = start + kTurn * (j + 0.8 * random_.uniform()) / v.count;
            v.at[j] = center + (size * std::cos(angle)) * a + (size * width * std::sin(angle)) * b;
        }
        return v;
    }

    /// A parallelogram with small integer coordinates, often degenerate.
    Vertices integer_quad() {
        const Vec o = integer_vector();
        const Vec a = integer_vector();
        const Vec b = integer_vector();
        return {{o, o + a, o + a + b, o + b}, 4};
    }
    Vec integer_vector() {
        const double x = random_.index(5) - 2;
        const double y = random_.index(5) - 2;
        return {x, y, random_.index(5) - 2.0};
    }

    static void translate(Vertices& v, const Vec& by) {
        for (int j = 0; j < v.count; ++j) v.at[j] = v.at[j] + by;
    }

    /// Zero, or a small offset, possibly denormal, to be added to coordinates that would be zero.
    double nudge() {
        if (random_.index(2) == 0) return 0;
        const double size = random_.index(2) == 0 ? random_.log_between(1e-12, 1e-3)
                                                  : kSmallest * random_.log_between(1, 1e9);
        return random_.index(2) == 0 ? size : -size;
    }
    Vec nudges() {
        const double x = nudge();
        const double y = nudge();
        return {x, y, nudge()};
    }

    void deform(Vertices& v) {
        const int j = random_.index(v.count);
        const int next = (j + 1) % v.count;
        const int before = (j + v.count - 1) % v.count;
        const Vec middle = 0.5 * (v.at[j] + v.at[next]);
        switch (random_.index(13)) {
        case 0: // repeated vertex
            v.at[j] = v.at[next];
            break;
        case 1: // collinear vertices; no area if it is a triangle
            v.at[j] = 0.5 * (v.at[before] + v.at[next]);
            break;
        case 2: // no area: along a line and back
            for (int i = 2; i < v.count; ++i)
                v.at[i] = v.at[0] + (v.count - i) / (v.count - 1.0) * (v.at[1] - v.at[0]);
            break;
        case 3: // point on a vertex or next to it
            translate(v, -v.at[j]);
            translate(v, nudges());
            break;
        case 4: // point on an edge or its carrier line
            translate(v, -(v.at[j] + random_.between(-1, 2) * (v.at[next] - v.at[j])));
            break;
        case 5: // point in the plane, inside the polygon or not
            translate(v, -(random_.between(0, 2) * v.at[0] + random_.between(0, 2) * v.at[1] +
                           random_.between(0, 2) * v.at[2]));
            break;
        case 6: { // edge-on up to a small angle
            const Vec normal = normalize(cross(v.at[1] - v.at[0], v.at[2] - v.at[0]));
            const double distance = dot(normal, v.at[0]);
            translate(v, (distance * random_.log_between(1e-12, 1) - distance) * normal);
            break;
        }
        case 7: // touches the horizon
            translate(v, {0, 0, -v.at[j].z});
            translate(v, {0, 0, nudge()});
            break;
        case 8: // vertex at the zenith
            translate(v, {-v.at[j].x, -v.at[j].y, 0});
            translate(v, {nudge(), 0, 0});
            break;
        case 9: // edge through the zenith
            translate(v, {-middle.x, -middle.y, 0});
            translate(v, {nudge(), 0, 0});
            break;
        case 10: // wall with vertical edges, standing on the horizon or crossing it
            v = wall(v.at[0], v.at[1]);
            break;
        case 11: { // in the plane of the horizon, parallel to it, or almost in it
            const double z = random_.index(2) == 0 ? nudge() : v.at[0].z;
            for (int i = 0; i < v.count; ++i) v.at[i].z = z;
            break;
        }
        default: { // shear that puts an edge on the horizon
            const Vec along = v.at[next] - v.at[j];
            const double slope = along.z / (along.x * along.x + along.y * along.y + 1e-300);
            const Vec begin = v.at[j];
            for (int i = 0; i < v.count; ++i) {
                const Vec offset = v.at[i] - begin;
                v.at[i].z = offset.z - slope * (offset.x * along.x + offset.y * along.y);
            }
            v.at[j].z = v.at[next].z = 0;
        }
        }
    }

    Vertices wall(const Vec& begin, const Vec& end) {
        const double top = random_.log_between(1e-3, 1e3);
        const double bottom = random_.index(2) == 0 ? nudge() : random_.between(-1, 1) * top;
        return {{{begin.x, begin.y, bottom},
                 {end.x, end.y, bottom},
                 {end.x, end.y, top},
                 {begin.x, begin.y, top}},
                4};
    }

    void deform(Vec& begin, Vec& end) {
        switch (random_.index(12)) {
        case 0: // directed at the point
            end = random_.log_between(1e-3, 1e3) * begin;
            break;
        case 1: // almost
            end = random_.log_between(1e-3, 1e3) * begin +
                  random_.log_between(1e-12, 1e-3) * random_.direction();
            break;
        case 2: // passes through the point
            end = -random_.log_between(1e-3, 1e3) * begin;
            break;
        case 3: // starts at the point or next to it
            begin = nudges();
            break;
        case 4: // in the plane of the horizon, or almost
            begin.z = nudge();
            end.z = random_.index(2) == 0 ? begin.z : nudge();
            break;
        case 5: // starts on the horizon, or almost
            begin.z = nudge();
            break;
        case 6: // no length
            end = begin;
            break;
        case 7: // vertical, sometimes through the zenith
            end = {begin.x, begin.y, end.z};
            if (random_.index(2) == 0) {
                begin.x = end.x = nudge();
                begin.y = end.y = 0;
            }
            break;
        case 8: // short and distant
            end = begin + random_.log_between(1e-12, 1e-3) * random_.direction();
            break;
        case 9: // small integers
            begin = integer_vector();
            end = integer_vector();
            break;
        case 10: // barely above the horizon
            begin.z = random_.log_between(1e-12, 1e-3);
            end.z = random_.index(2) == 0 ? begin.z : -begin.z;
            break;
        default:
            break;
        }
    }

    /// \param v the centre and the semi-diameters.
    void deform(Vec& center, Vec (&v)[4]) {
        switch (random_.index(10)) {
        case 0: // the point next to the surface or the rim, on either side
            center = (1 + (random_.index(2) == 0 ? -1 : 1) * random_.log_between(1e-12, 1)) *
                     v[1 + random_.index(3)];
            break;
        case 1: // on it
            center = v[1 + random_.index(3)];
            break;
        case 2: // close to the inside of a disk
            center = random_.between(-1, 1) * v[1] + random_.log_between(1e-12, 1) * v[3];
            break;
        case 3: // at the centre, or next to it
            center = nudges();
            break;
        case 4: // on the horizon, or almost
            center.z = nudge();
            break;
        case 5: // touches the horizon
            center.z = std::sqrt(v[1].z * v[1].z + v[2].z * v[2].z) + nudge();
            break;
        case 6: // in the zenith
            center.x = nudge();
            center.y = nudge();
            break;
        case 7: // no extent in one direction
            v[1 + random_.index(3)] = {0, 0, 0};
            break;
        case 8: // parallel semi-diameters
            v[2] = random_.between(-1, 1) * v[1] + random_.log_between(1e-12, 1e-3) * v[2];
            break;
        default: // flat, or seen edge-on
            v[3] = random_.log_between(1e-12, 1e-1) * v[3];
            center = center - dot(center, normalize(v[3])) * normalize(v[3]);
        }
    }

    RandomSource random_;
};

} // namespace hostile
NUSSELT_NAMESPACE_END
