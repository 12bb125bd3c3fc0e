#pragma once
/// What is prepared once per environment map: grids of mean radiance, and from where it comes on average.

#include <nusselt/emission/bilinear_texel.h>
#include <nusselt/emission/octahedral_map.h>
#include <nusselt/emission/texture_pyramid.h>

NUSSELT_NAMESPACE_BEGIN

/// Light from all directions, infinitely far away, in a space of its own. It refers to the texels and to the storage, which the
/// caller owns; its own size does not depend on that of the map. One map serves all shading points.
/// \tparam T float, double or long double.
/// \tparam n columns and rows of the lattice: 8 or 16. Cell (i, j) has the index j * n + i.
template <class T, int n>
struct EnvironmentMap {
    static_assert(n == 8 || n == 16, "lanes of a pack are neighbouring cells of a row");
    static constexpr int kCells = n * n;
    /// Solid angle of a cell [sr].
    static constexpr T kCellAngle = 4 * kPi<T> / kCells;

    OctahedralMap<T> radiance;
    /// Mean radiance over elements, averaged over channels, times scale: exact for interpolated lookups. 0 only where the map is
    /// black, or darker than 1e-38 (float) of its brightest texel.
    TexturePyramid<T> pyramid;
    /// Mean directions of elements, weighted by radiance, for all grids but the finest one. They are shorter than one, and zero
    /// for black elements. direction_at() has the order of the numbers.
    const T* direction;
    T scale;           ///< a power of two: the brightest texel has a weight of order one
    T texel_variance;  ///< of directions in a texel, per axis
    T mean[3][kCells]; ///< mean radiance per channel and cell [W/(sr m^2)]

    /// How many numbers the storage of a map has: about 7/3 per texel.
    NUSSELT_HD static int storage_size(int size) noexcept {
        const PyramidShape shape(n, size, size);
        return shape.size + 3 * (shape.size - size * size);
    }

    /// Distance of the x from the y coordinates, and of these from the z coordinates of directions.
    NUSSELT_HD int stride() const noexcept { return pyramid.shape.size - pyramid.shape.offset[1]; }
    /// x coordinate of the mean direction of an element. \param level at least 1.
    NUSSELT_HD const T* direction_at(int level, int i, int j) const noexcept {
        return direction + pyramid.shape.index(level, i, j) - pyramid.shape.offset[1];
    }

    /// The variance of directions per axis, from the length of their mean.
    template <class Real>
    NUSSELT_INLINE Real variance_of(const Vec3<Real>& mean_direction) const noexcept {
        return multiply_add(Real(T(1) / T(3)), max(Real(1) - dot(mean_direction, mean_direction), Real(0)),
                            Real(texel_variance));
    }

    /// The interpolated lookups in a texel, averaged over channels.
    NUSSELT_HD detail::BilinearTexel<T> texel_at(int i, int j) const noexcept {
        detail::BilinearTexel<T> texel;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                texel.value[row][column] = mean_of_channels(radiance.at(i + column - 1, j + row - 1));
        return texel;
    }

    /// Mean radiance over all directions, per channel [W/(sr m^2)].
    NUSSELT_HD Vec3<T> mean_radiance() const noexcept {
        Vec3<T> sum{T(0), T(0), T(0)};
        for (int c = 0; c < kCells; ++c) sum += Vec3<T>{mean[0][c], mean[1][c], mean[2][c]};
        return sum / T(kCells);
    }
};

namespace detail {

/// The mean radiance over a texel: the weights are 1/8, 6/8, 1/8 in both directions.
template <class T>
NUSSELT_HD inline Vec3<T> mean_over_texel(const OctahedralMap<T>& map, int i, int j) noexcept {
    constexpr T kShare[3] = {T(0.125), T(0.75), T(0.125)};
    Vec3<T> sum{T(0), T(0), T(0)};
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            sum += (kShare[row] * kShare[column]) * map.at(i + column - 1, j + row - 1);
    return sum;
}

/// Fills the finest grid and the mean radiance of cells.
template <class T, int n>
NUSSELT_HD inline void fill_texels(EnvironmentMap<T, n>& map, T* weight) noexcept {
    using Sum = std::conditional_t<std::is_same_v<T, float>, double, T>;
    const int size = map.radiance.size;
    const int texels = size / n;
    for (int row = 0; row < n; ++row) {
        for (int column = 0; column < n; ++column) {
            Vec3<Sum> sum{Sum(0), Sum(0), Sum(0)};
            for (int j = row * texels; j < (row + 1) * texels; ++j) {
                for (int i = column * texels; i < (column + 1) * texels; ++i) {
                    const Vec3<T> mean = mean_over_texel(map.radiance, i, j);
                    weight[map.pyramid.shape.index(0, i, j)] = mean_of_channels(map.scale * mean);
                    sum += broadcast<Sum>(mean);
                }
            }
            const int cell = row * n + column;
            const auto share = static_cast<Sum>(texels * texels);
            map.mean[0][cell] = static_cast<T>(sum.x / share);
            map.mean[1][cell] = static_cast<T>(sum.y / share);
            map.mean[2][cell] = static_cast<T>(sum.z / share);
        }
    }
}

/// Fills the mean directions of all grids but the finest one.
template <class T, int n>
NUSSELT_HD inline void fill_directions(const EnvironmentMap<T, n>& map, T* direction) noexcept {
    const PyramidShape& shape = map.pyramid.shape;
    const int stride = map.stride();
    for (int level = 1; level < shape.levels; ++level) {
        const int size = shape.width_of(level);
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i) {
                const ElementParts<T> parts = emitting_parts(map.pyramid, level, i, j);
                const T total = parts.column(0) + parts.column(1);
                const T inverse = total > T(0) ? T(1) / total : T(0);
                Vec3<T> sum{T(0), T(0), T(0)};
                for (int k = 0; k < 4; ++k) {
                    const int column = 2 * i + k % 2;
                    const int row = 2 * j + k / 2;
                    Vec3<T> part;
                    if (level == 1) {
                        const T step = T(1) / static_cast<T>(2 * size);
                        part = octahedral_direction(Vec2<T>{(static_cast<T>(column) + T(0.5)) * step,
                                                            (static_cast<T>(row) + T(0.5)) * step});
                    } else {
                        const T* const x = map.direction_at(level - 1, column, row);
                        part = {x[0], x[stride], x[2 * stride]};
                    }
                    sum += (inverse * parts.weight[k]) * part;
                }
                T* const x = direction + (map.direction_at(level, i, j) - map.direction);
                x[0] = sum.x;
                x[stride] = sum.y;
                x[2 * stride] = sum.z;
            }
        }
    }
}

} // namespace detail

/// \tparam n        columns and rows of the lattice, 8 or 16.
/// \param  radiance of a size that is a power of two from 2 n to 2^14. Texels are finite and not negative, and at most a
///                  hundredth of the largest number; others are errors of the caller.
/// \param  storage  EnvironmentMap<T, n>::storage_size(radiance.size) numbers, which the map refers to. First come the weights of
///                  the grids, from the finest to the lattice, then the x, y and z coordinates of directions.
template <int n, class T>
NUSSELT_HD inline EnvironmentMap<T, n> make_environment_map(const OctahedralMap<T>& radiance,
                                                            T* storage) noexcept {
    const PyramidShape shape(n, radiance.size, radiance.size);
    T brightest = T(0);
    for (int k = 0; k < radiance.size * radiance.size; ++k)
        brightest = max(brightest, mean_of_channels(radiance.texel[k]));
    const T texels = static_cast<T>(radiance.size) * static_cast<T>(radiance.size);
    EnvironmentMap<T, n> map{radiance,
                             {shape, storage},
                             storage + shape.size,
                             brightest > T(0) ? reciprocal_power_of_two(brightest) : T(1),
                             kPi<T> / (T(3) * texels),
                             {}};
    detail::fill_texels(map, storage);
    fill_pyramid(shape, storage);
    detail::fill_directions(map, storage + shape.size);
    return map;
}

NUSSELT_NAMESPACE_END
