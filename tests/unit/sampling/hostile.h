#pragma once
/// Seeded generators of lights that break samplers: everything here is legal input.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <nusselt/geometry/convex_polygon.h>
#include <nusselt/geometry/line_segment.h>

namespace nusselt_test {

/// Random numbers that do not depend on the standard library's distributions.
class RandomSource {
public:
    explicit RandomSource(std::uint64_t seed) : engine_(seed) {}

    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    double log_between(double low, double high) { return low * std::pow(high / low, uniform()); }
    int index(int count) { return static_cast<int>(uniform() * count); }
    nusselt::Vec3<double> direction() {
        const double z = between(-1, 1);
        const double azimuth = between(0, 6.283185307179586);
        const double radius = std::sqrt(1 - z * z);
        return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
    }

private:
    std::mt19937_64 engine_;
};

/// Hostile lights with coordinates of type T.
template <class T>
class HostileLights {
    using Vec = nusselt::Vec3<double>;

public:
    explicit HostileLights(std::uint64_t seed) : random_(seed) {}

    /// Random numbers include 0, the largest below 1 and tiny ones.
    T random_number() {
        switch (random_.index(8)) {
        case 0:
            return 0;
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

    /// A polygon with 3 to N vertices in either winding.
    template <int N = 4>
    nusselt::ConvexPolygon<T, N> polygon() {
        std::vector<Vec> v = random_.index(10) == 0 ? integer_quad() : round_polygon(N);
        const int changes = random_.index(3);
        for (int i = 0; i < changes; ++i) deform(v);
        if (random_.index(2) == 0) std::reverse(v.begin(), v.end());
        const double unit = unit_of_length();
        nusselt::Vec3<T> vertices[N] = {};
        for (std::size_t j = 0; j < v.size(); ++j) vertices[j] = rounded(v[j], unit);
        return nusselt::make_polygon<N>(vertices, static_cast<int>(v.size()));
    }

    nusselt::LineSegment<T> line() {
        const Vec middle = random_.direction();
        const Vec half = random_.log_between(1e-6, 1e6) * random_.direction();
        Vec begin = middle - half;
        Vec end = middle + half;
        deform(begin, end);
        if (random_.index(2) == 0) std::swap(begin, end);
        const double unit = unit_of_length();
        return nusselt::make_line(rounded(begin, unit), rounded(end, unit));
    }

private:
    static constexpr T kLargestBelowOne = 1 - std::numeric_limits<T>::epsilon() / 2;

    /// Mostly moderate, sometimes such that coordinates are denormal or about 1e15.
    double unit_of_length() {
        switch (random_.index(12)) {
        case 0:
            return 1e15 / 1e6;
        case 1:
            return static_cast<double>(std::max(static_cast<T>(std::numeric_limits<double>::min()),
                                                std::numeric_limits<T>::min())) *
                   random_.log_between(1e-6, 1e3);
        case 2:
            return random_.log_between(1e-6, 1e6);
        default:
            return 1;
        }
    }

    static nusselt::Vec3<T> rounded(const Vec& v, double unit) {
        return {static_cast<T>(unit * v.x), static_cast<T>(unit * v.y), static_cast<T>(unit * v.z)};
    }

    /// Inscribed in an ellipse of random orientation, of any size relative to its distance.
    std::vector<Vec> round_polygon(int largest_count) {
        const Vec center = random_.direction();
        const Vec a = random_.direction();
        const Vec b = normalize(cross(a, random_.direction()));
        const double size = random_.log_between(1e-6, 1e6);
        const double width = random_.index(4) == 0 ? random_.log_between(1e-8, 1) : 1;
        const int count = 3 + random_.index(largest_count - 2);
        const double start = random_.between(0, 6.3);
        std::vector<Vec> v;
        for (int j = 0; j < count; ++j) {
            const double angle = start + 6.283185307179586 * (j + 0.8 * random_.uniform()) / count;
            v.push_back(center + (size * std::cos(angle)) * a + (size * width * std::sin(angle)) * b);
        }
        return v;
    }

    /// A parallelogram with small integer coordinates, often degenerate.
    std::vector<Vec> integer_quad() {
        const Vec o = integer_vector();
        const Vec a = integer_vector();
        const Vec b = integer_vector();
        return {o, o + a, o + a + b, o + b};
    }
    Vec integer_vector() {
        const auto coordinate = [&] { return static_cast<double>(random_.index(5) - 2); };
        const double x = coordinate();
        const double y = coordinate();
        return {x, y, coordinate()};
    }

    static void translate(std::vector<Vec>& v, const Vec& by) {
        for (Vec& p : v) p = p + by;
    }

    void deform(std::vector<Vec>& v) {
        const auto count = static_cast<int>(v.size());
        const auto j = static_cast<std::size_t>(random_.index(count));
        const auto next = (j + 1) % v.size();
        const auto before = (j + v.size() - 1) % v.size();
        const Vec middle = 0.5 * (v[j] + v[next]);
        switch (random_.index(13)) {
        case 0: // repeated vertex
            v[j] = v[next];
            break;
        case 1: // collinear vertices; no area if it is a triangle
            v[j] = 0.5 * (v[before] + v[next]);
            break;
        case 2: // no area: along a line and back
            for (int i = 2; i < count; ++i) {
                v[static_cast<std::size_t>(i)] = v[0] + (count - i) / (count - 1.0) * (v[1] - v[0]);
            }
            break;
        case 3: // point on a vertex
            translate(v, -v[j]);
            break;
        case 4: // point on an edge or its carrier line
            translate(v, -(v[j] + random_.between(-1, 2) * (v[next] - v[j])));
            break;
        case 5: // point in the plane, inside of the polygon or not
            translate(v, -(random_.between(0, 2) * v[0] + random_.between(0, 2) * v[1] +
                           random_.between(0, 2) * v[2]));
            break;
        case 6: { // edge-on up to a small angle
            const Vec normal = normalize(cross(v[1] - v[0], v[2] - v[0]));
            const double distance = dot(normal, v[0]);
            translate(v, (distance * random_.log_between(1e-12, 1) - distance) * normal);
            break;
        }
        case 7: // touches the horizon
            translate(v, {0, 0, -v[j].z});
            break;
        case 8: // vertex at the zenith
            translate(v, {-v[j].x, -v[j].y, 0});
            break;
        case 9: // edge through the zenith
            translate(v, {-middle.x, -middle.y, 0});
            break;
        case 10: { // wall with vertical edges, standing on the horizon or crossing it
            const double top = random_.log_between(1e-3, 1e3);
            const double bottom = random_.index(2) == 0 ? 0 : random_.between(-1, 1) * top;
            v = {{v[0].x, v[0].y, bottom},
                 {v[1].x, v[1].y, bottom},
                 {v[1].x, v[1].y, top},
                 {v[0].x, v[0].y, top}};
            break;
        }
        case 11: { // in the plane of the horizon, or parallel to it
            const double z = random_.index(2) == 0 ? 0 : v[0].z;
            for (Vec& p : v) p.z = z;
            break;
        }
        default: { // shear that puts an edge on the horizon
            const Vec along = v[next] - v[j];
            const double slope = along.z / (along.x * along.x + along.y * along.y + 1e-300);
            const Vec begin = v[j];
            for (Vec& p : v) {
                const Vec offset = p - begin;
                p.z = offset.z - slope * (offset.x * along.x + offset.y * along.y);
            }
            v[j].z = v[next].z = 0;
        }
        }
    }

    void deform(Vec& begin, Vec& end) {
        switch (random_.index(12)) {
        case 0: // points at the point
            end = random_.log_between(1e-3, 1e3) * begin;
            break;
        case 1: // almost
            end = random_.log_between(1e-3, 1e3) * begin +
                  random_.log_between(1e-12, 1e-3) * random_.direction();
            break;
        case 2: // passes through the point
            end = -random_.log_between(1e-3, 1e3) * begin;
            break;
        case 3: // begins at the point
            begin = {0, 0, 0};
            break;
        case 4: // in the plane of the horizon
            begin.z = end.z = 0;
            break;
        case 5: // begins on the horizon
            begin.z = 0;
            break;
        case 6: // no length
            end = begin;
            break;
        case 7: // vertical, sometimes through the zenith
            end = {begin.x, begin.y, end.z};
            if (random_.index(2) == 0) begin.x = begin.y = end.x = end.y = 0;
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

    RandomSource random_;
};

} // namespace nusselt_test
