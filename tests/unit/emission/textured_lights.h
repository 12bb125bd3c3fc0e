#pragma once
/// Textures, and lights that show them, for tests.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include <nusselt/emission/textured_polygon.h>

namespace nusselt_test {

/// A grey texture as wide as it is high, with the values of a function of the column and the row.
template <class T>
struct SquareTexture {
    std::vector<nusselt::Vec3<T>> texels;
    int size;

    template <class Value>
    SquareTexture(int texture_size, const Value& value) : size(texture_size) {
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i) {
                const auto x = static_cast<T>(value(i, j));
                texels.push_back({x, x, x});
            }
        }
    }

    nusselt::TextureView<T> view() const { return {texels.data(), size, size}; }
};

/// A light with the storage of its pyramid.
template <class T, int n>
struct StoredLight {
    std::vector<T> storage;
    nusselt::TexturedLight<T, n> light;

    template <class Filter>
    StoredLight(Filter, const nusselt::TextureView<T>& view, const std::vector<nusselt::Vec2<T>>& outline)
        : storage(static_cast<std::size_t>(nusselt::PyramidShape(n, view.width, view.height).size)),
          light(nusselt::make_textured_light<Filter, n>(view, outline.data(),
                                                        static_cast<int>(outline.size()), storage.data())) {}
};

template <class T>
std::vector<nusselt::Vec2<T>> unit_square() {
    return {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

/// Outlines with three to eight vertices, in both windings, some with edges on lines of the lattice.
template <class T>
std::vector<std::vector<nusselt::Vec2<T>>> outlines() {
    std::vector<nusselt::Vec2<T>> octagon;
    for (int k = 0; k < 8; ++k) {
        const double angle = 0.3 + k * 0.785398;
        octagon.push_back(
            {static_cast<T>(0.5 + 0.45 * std::cos(angle)), static_cast<T>(0.5 + 0.3 * std::sin(angle))});
    }
    return {unit_square<T>(),
            {{T(0.1), T(0.05)}, {T(0.93), T(0.2)}, {T(0.4), T(0.95)}},
            {{0, 0}, {0, 1}, {1, T(0.5)}},
            {{T(0.25), T(0.25)}, {T(0.75), T(0.25)}, {T(0.75), T(0.5)}, {T(0.25), T(0.5)}},
            octagon};
}

struct NamedTexture {
    std::string name;
    SquareTexture<float> texture;
};

/// What lights show, from smooth to hardly lit at all: values between 0 and 1, but for the spikes.
inline std::vector<NamedTexture> make_named_textures() {
    constexpr int kSize = 256;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<NamedTexture> list;
    list.push_back({"constant", {kSize, [](int, int) { return 0.7; }}});
    list.push_back({"gradient", {kSize, [](int i, int) { return 0.25 + (i + 0.5) / kSize; }}});

    // Disks of all sizes on top of each other have the statistics of photographs.
    struct Disk {
        double x, y, radius, value;
    };
    const auto squared_distance = [](const Disk& disk, int i, int j) {
        return (i - disk.x) * (i - disk.x) + (j - disk.y) * (j - disk.y);
    };
    std::vector<Disk> disks;
    for (int k = 0; k < 1500; ++k) {
        const double radius = std::min(0.0133 / std::sqrt(uniform(random) + 1e-3), 0.4);
        const double x = uniform(random), y = uniform(random);
        disks.push_back({x * kSize, y * kSize, radius * kSize, std::pow(uniform(random), 2.2)});
    }
    list.push_back({"television", {kSize, [&](int i, int j) {
                                       for (auto disk = disks.rbegin(); disk != disks.rend(); ++disk)
                                           if (squared_distance(*disk, i, j) < disk->radius * disk->radius)
                                               return disk->value;
                                       return 0.3;
                                   }}});

    // Panes around the nearest of some points, with black lead in between.
    std::vector<Disk> panes;
    for (int k = 0; k < 40; ++k) {
        const double x = uniform(random), y = uniform(random);
        panes.push_back({x * kSize, y * kSize, 0, 0.2 + 0.4 * uniform(random)});
    }
    const auto glass = [&](int i, int j) {
        double nearest = 1e9, second = 1e9, value = 0;
        for (const Disk& pane : panes) {
            const double distance = squared_distance(pane, i, j);
            if (distance < nearest) {
                second = nearest;
                nearest = distance;
                value = pane.value;
            } else {
                second = std::min(second, distance);
            }
        }
        return std::sqrt(second) - std::sqrt(nearest) < 3 ? 0 : value;
    };
    list.push_back({"stained glass", {kSize, glass}});

    std::vector<Disk> spikes;
    for (int k = 0; k < 6; ++k) {
        const double x = uniform(random), y = uniform(random);
        spikes.push_back({10 + x * (kSize - 20), 10 + y * (kSize - 20), 2.8, 100 + 400 * uniform(random)});
    }
    list.push_back({"spikes", {kSize, [&](int i, int j) {
                                   for (const Disk& spike : spikes)
                                       if (squared_distance(spike, i, j) < spike.radius * spike.radius)
                                           return spike.value;
                                   return static_cast<double>(glass(i, j));
                               }}});
    return list;
}

inline const std::vector<NamedTexture>& named_textures() {
    static const std::vector<NamedTexture> list = make_named_textures();
    return list;
}

/// The unit square seen from points at a distance from its centre, in the frames of random surfaces that face it at least in
/// part. Some horizons cut it.
inline std::vector<nusselt::TexturePlane<double>> views_of_unit_square(double distance, int count) {
    using Vector = nusselt::Vec3<double>;
    std::mt19937 random(static_cast<unsigned>(1000 * distance));
    std::uniform_real_distribution<double> uniform(0, 1);
    std::normal_distribution<double> normal;
    std::vector<nusselt::TexturePlane<double>> views;
    while (static_cast<int>(views.size()) < count) {
        const double z = 0.3 + 0.7 * uniform(random);
        const double azimuth = 6.2831853 * uniform(random);
        const double across = std::sqrt(1 - z * z);
        const Vector point = Vector{0.5, 0.5, 0} +
                             distance * Vector{across * std::cos(azimuth), across * std::sin(azimuth), z};
        const double x = normal(random), y = normal(random);
        const auto frame = nusselt::Frame<double>::from_normal(normalize(Vector{x, y, normal(random)}));
        const auto world = nusselt::make_texture_plane<double>({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
        const auto view = to_shading_space(world, point, frame);
        // At least the centre is well above the horizon.
        if (view.point_at({0.5, 0.5}).z > 0.1 * distance) views.push_back(view);
    }
    return views;
}

template <class To, class From>
nusselt::TexturePlane<To> converted(const nusselt::TexturePlane<From>& plane) {
    return {nusselt::broadcast<To>(plane.corner), nusselt::broadcast<To>(plane.side_x),
            nusselt::broadcast<To>(plane.side_y), nusselt::broadcast<To>(plane.normal)};
}

/// The solid angle per share of the texture at a point.
template <class T>
T solid_angle_density(const nusselt::TexturePlane<T>& plane, const nusselt::Vec2<T>& at) {
    const nusselt::Vec3<T> p = plane.point_at(at);
    const T squared = dot(p, p);
    return std::fabs(dot(p, cross(plane.side_x, plane.side_y))) / (squared * std::sqrt(squared));
}

} // namespace nusselt_test
