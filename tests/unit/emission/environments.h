#pragma once
/// Environment maps for tests, with integrals over them.

#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include <nusselt/emission/environment_sampling.h>

namespace nusselt_test {

/// The texels of a map, from a function of the direction or of the indices.
template <class T>
struct MapTexels {
    std::vector<nusselt::Vec3<T>> texels;
    int size;

    template <class Radiance>
    MapTexels(int map_size, const Radiance& radiance) : size(map_size) {
        for (int j = 0; j < size; ++j)
            for (int i = 0; i < size; ++i) texels.push_back(radiance(i, j));
    }
    nusselt::OctahedralMap<T> view() const { return {texels.data(), size}; }
};

template <class T>
nusselt::Vec3<T> texel_centre(int size, int i, int j) {
    return nusselt::octahedral_direction(
        nusselt::Vec2<T>{(static_cast<T>(i) + T(0.5)) / static_cast<T>(size),
                         (static_cast<T>(j) + T(0.5)) / static_cast<T>(size)});
}

template <class T>
nusselt::Vec3<T> grey(double x) {
    return {static_cast<T>(x), static_cast<T>(x), static_cast<T>(x)};
}

/// Texels with the values of a function of their direction.
template <class T, class Radiance>
MapTexels<T> texels_of(int size, const Radiance& radiance) {
    return {size, [&](int i, int j) { return radiance(texel_centre<double>(size, i, j)); }};
}

/// A map with its storage.
template <class T, int n>
struct StoredMap {
    std::vector<T> storage;
    nusselt::EnvironmentMap<T, n> map;

    explicit StoredMap(const nusselt::OctahedralMap<T>& view)
        : storage(static_cast<std::size_t>(nusselt::EnvironmentMap<T, n>::storage_size(view.size))),
          map(nusselt::make_environment_map<n>(view, storage.data())) {}
};

inline nusselt::Vec3<double> sun_direction() { return normalize(nusselt::Vec3<double>{0.5, 0.3, 0.6}); }

/// Brighter above and on one side, above a dim ground.
inline double sky(const nusselt::Vec3<double>& w) {
    return 0.3 + 0.7 * std::max(w.z, 0.0) + (w.x > 0.3 ? 0.2 : 0);
}
/// With a disk of a radius of one degree that is 3000 times as bright.
inline double sky_with_sun(const nusselt::Vec3<double>& w) {
    return sky(w) + (dot(w, sun_direction()) > std::cos(0.0174533) ? 3000 : 0);
}

/// Surfaces with random normals.
inline std::vector<nusselt::Frame<double>> random_frames(int count) {
    std::mt19937 random(17);
    std::normal_distribution<double> normal;
    std::vector<nusselt::Frame<double>> frames;
    while (static_cast<int>(frames.size()) < count) {
        const double x = normal(random), y = normal(random);
        frames.push_back(
            nusselt::Frame<double>::from_normal(normalize(nusselt::Vec3<double>{x, y, normal(random)})));
    }
    return frames;
}

/// Surfaces for which the sun is within a tenth of a radian of the horizon.
inline std::vector<nusselt::Frame<double>> frames_at_sunset(int count) {
    std::mt19937 random(18);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    std::vector<nusselt::Frame<double>> frames;
    for (const auto& frame : random_frames(count)) {
        const auto sun = sun_direction();
        const auto across = normalize(cross(frame.n, sun));
        frames.push_back(nusselt::Frame<double>::from_normal(normalize(across + uniform(random) * sun)));
    }
    return frames;
}

template <class To, class From>
nusselt::Frame<To> converted(const nusselt::Frame<From>& frame) {
    return nusselt::broadcast<To>(frame);
}

/// Directions and radiance of a map at the centres of the quarters of texels, each of which has the same solid angle.
/// There, interpolation is a polynomial.
struct MapPoint {
    nusselt::Vec2<double> at;
    nusselt::Vec3<double> direction;
    double radiance; ///< averaged over channels
};
template <class T>
std::vector<MapPoint> points_of(const nusselt::OctahedralMap<T>& map) {
    std::vector<MapPoint> points;
    for (int j = 0; j < 2 * map.size; ++j) {
        for (int i = 0; i < 2 * map.size; ++i) {
            const nusselt::Vec2<double> at{(i + 0.5) / (2 * map.size), (j + 0.5) / (2 * map.size)};
            const auto radiance = map.lookup(nusselt::broadcast<T>(at));
            points.push_back({at, nusselt::octahedral_direction(at),
                              static_cast<double>(nusselt::mean_of_channels(radiance))});
        }
    }
    return points;
}

/// The integral over all directions of radiance times a function of the direction in shading space.
template <class Integrand>
double integral(const std::vector<MapPoint>& points, const nusselt::Frame<double>& frame,
                const Integrand& integrand) {
    double sum = 0;
    for (const MapPoint& point : points) sum += point.radiance * integrand(frame.to_local(point.direction));
    return sum * 4 * nusselt::kPi<double> / static_cast<double>(points.size());
}

} // namespace nusselt_test
