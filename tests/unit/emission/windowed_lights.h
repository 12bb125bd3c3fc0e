#pragma once
/// Maps of radiance by direction, and lights that show them, for tests.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <nusselt/emission/windowed_polygon.h>

namespace nusselt_test {

/// A table with its storage.
template <class T>
struct StoredTable {
    std::vector<nusselt::RectifiedSums> sums;
    std::vector<nusselt::Vec3<T>> colour;
    nusselt::RectifiedTable<T> table;

    template <class Radiance>
    StoredTable(const Radiance& radiance, const nusselt::RectifiedDomain<T>& domain, int width, int height,
                int lookups)
        : sums(static_cast<std::size_t>(nusselt::RectifiedTable<T>::size(width, height))),
          colour(sums.size()),
          table(nusselt::make_rectified_table<T>(radiance, domain, width, height, lookups, sums.data(),
                                                 colour.data())) {}
};

/// A table with refined texels.
template <class T>
struct RefinedTable : StoredTable<T> {
    static constexpr int kMost = 10000;
    std::vector<std::int32_t> texels;
    std::vector<T> weights;

    template <class Radiance>
    RefinedTable(const Radiance& radiance, int size)
        : StoredTable<T>(radiance, nusselt::RectifiedDomain<T>::hemisphere(), size, size, 2),
          texels(kMost),
          weights(static_cast<std::size_t>(kMost) * nusselt::RefinedTexels<T>::kSize) {
        nusselt::refine_rectified_table<T>(radiance, this->table, kMost, texels.data(), weights.data());
    }
};

/// Grey values of texels over the hemisphere.
class TexelMap {
public:
    /// \param value(direction) at the centre of each texel.
    template <class Value>
    TexelMap(int texels, const Value& value) : size(texels) {
        for (int j = 0; j < size; ++j)
            for (int i = 0; i < size; ++i) values_.push_back(value(direction_at(i + 0.5, j + 0.5)));
    }

    double angle_at(double position) const { return (position / size - 0.5) * nusselt::kPi<double>; }
    nusselt::Vec3<double> direction_at(double i, double j) const {
        return normalize(nusselt::Vec3<double>{std::tan(angle_at(i)), std::tan(angle_at(j)), 1});
    }
    double at_texel(int i, int j) const { return values_[static_cast<std::size_t>(j * size + i)]; }
    template <class T>
    double at_position(const nusselt::Vec2<T>& at) const {
        return at_texel(std::min(static_cast<int>(at.x * static_cast<T>(size)), size - 1),
                        std::min(static_cast<int>(at.y * static_cast<T>(size)), size - 1));
    }
    template <class T>
    double operator()(const nusselt::Vec3<T>& w) const {
        const double x = std::atan2(static_cast<double>(w.x), static_cast<double>(w.z));
        const double y = std::atan2(static_cast<double>(w.y), static_cast<double>(w.z));
        return at_position(
            nusselt::Vec2<double>{x / nusselt::kPi<double> + 0.5, y / nusselt::kPi<double> + 0.5});
    }
    /// Between the centres of texels, for directions that are not at the edge.
    template <class T>
    double interpolated(const nusselt::Vec3<T>& w) const {
        const double x =
            (std::atan2(static_cast<double>(w.x), static_cast<double>(w.z)) / nusselt::kPi<double> + 0.5) *
                size -
            0.5;
        const double y =
            (std::atan2(static_cast<double>(w.y), static_cast<double>(w.z)) / nusselt::kPi<double> + 0.5) *
                size -
            0.5;
        const int i = std::clamp(static_cast<int>(std::floor(x)), 0, size - 2);
        const int j = std::clamp(static_cast<int>(std::floor(y)), 0, size - 2);
        const double s = std::clamp(x - i, 0.0, 1.0), t = std::clamp(y - j, 0.0, 1.0);
        return (1 - t) * ((1 - s) * at_texel(i, j) + s * at_texel(i + 1, j)) +
               t * ((1 - s) * at_texel(i, j + 1) + s * at_texel(i + 1, j + 1));
    }

    int size;

private:
    std::vector<double> values_;
};

template <class T>
nusselt::Vec3<T> grey(double value) {
    const T x = static_cast<T>(value);
    return {x, x, x};
}

/// A table with the values of a map.
template <class T>
StoredTable<T> table_of(const TexelMap& map) {
    return {[&](const nusselt::Vec3<T>& w) { return grey<T>(map(w)); },
            nusselt::RectifiedDomain<T>::hemisphere(), map.size, map.size, 1};
}

template <class T>
nusselt::Frame<T> upright() {
    return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
}

/// A rectangle across z at a height, and its corners in world space.
template <class T>
std::vector<nusselt::Vec3<T>> rectangle_at(T height, T left, T right, T bottom, T top) {
    return {{left, bottom, height}, {right, bottom, height}, {right, top, height}, {left, top, height}};
}

template <class T>
nusselt::WindowedLight<T> portal_of(const std::vector<nusselt::Vec3<T>>& vertices,
                                    const nusselt::RectifiedTable<T>& table) {
    return nusselt::make_portal(upright<T>(), vertices.data(), static_cast<int>(vertices.size()), table);
}

/// The mean of estimates and their relative standard deviation.
struct Estimates {
    double sum = 0, squares = 0;
    int count = 0;

    void add(double x) {
        sum += x;
        squares += x * x;
        ++count;
    }
    double mean() const { return sum / count; }
    double relative_variance() const { return mean() > 0 ? squares / count / (mean() * mean()) - 1 : 0; }
    /// Whether the mean is that of a value known to a relative error, up to five standard deviations.
    bool agrees_with(double expected, double error) const {
        const double deviation = std::sqrt(std::max(relative_variance(), 0.0) / count) * mean();
        return std::fabs(mean() - expected) < 5 * deviation + error * expected;
    }
};

} // namespace nusselt_test
