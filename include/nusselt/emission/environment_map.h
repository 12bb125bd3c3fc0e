#pragma once
/// What is prepared once per environment map: mean radiance of the elements of a pyramid, and from where it comes.

#include <nusselt/emission/bilinear_texel.h>
#include <nusselt/emission/octahedral_map.h>

NUSSELT_NAMESPACE_BEGIN

/// Light from all directions, infinitely far away, in a space of its own. It refers to the texels and to the storage,
/// which the caller owns; its own size does not depend on that of the map. One map serves all shading points.
///
/// Elements have a weight, and a direction: the mean over the element, weighted by radiance, shorter than one. Weights
/// are mean radiance, averaged over channels, times scale; exact for interpolated lookups. They are 0 only where the
/// map is black, or darker than 1e-38 (float) of its brightest texel. The four parts of an element are next to each
/// other in the storage, so that a step of a descent reads one line of the cache.
/// \tparam T float, double or long double.
/// \tparam n columns and rows of the lattice: 8 or 16. Cell (i, j) has the index j * n + i.
template <class T, int n>
struct EnvironmentMap {
    static_assert(n == 8 || n == 16, "lanes of a pack are neighbouring cells of a row");
    static constexpr int kCells = n * n;
    /// Solid angle of a cell [sr].
    static constexpr T kCellAngle = 4 * kPi<T> / kCells;
    /// Numbers per element in the storage: weights of its parts (0, 0), (1, 0), (0, 1), (1, 1), then the x, y and z
    /// coordinates of their directions.
    static constexpr int kPerElement = 16;

    OctahedralMap<T> radiance;
    PyramidShape shape;
    const T* texel_weights; ///< 4 numbers per element of grid 1
    const T* elements;      ///< kPerElement numbers per element of grids 2 and above
    T scale;                ///< a power of two: the brightest texel has a weight of order one
    T texel_variance;       ///< of directions in a texel, per axis

    // Per cell.
    T weight[kCells];
    T direction[3][kCells];
    T mean[3][kCells]; ///< mean radiance per channel [W/(sr m^2)]

    /// How many numbers the storage of a map has: about 7/3 per texel.
    NUSSELT_HD static int storage_size(int size) noexcept {
        const PyramidShape shape(n, size, size);
        return size * size + (shape.levels > 2 ? kPerElement * (shape.size - shape.offset[2]) : 0);
    }

    /// Where the weights of the parts of an element of grid 1 are.
    NUSSELT_HD int texel_index(int i, int j) const noexcept { return 4 * (j * shape.width_of(1) + i); }
    /// Where the numbers of an element are. \param level at least 2.
    NUSSELT_HD int element_index(int level, int i, int j) const noexcept {
        return kPerElement * (shape.offset[level] - shape.offset[2] + j * shape.width_of(level) + i);
    }
    /// Which part of an element of the next grid an element is.
    NUSSELT_HD static constexpr int part_of(int i, int j) noexcept { return 2 * (j & 1) + (i & 1); }

    NUSSELT_HD T texel_weight(int i, int j) const noexcept {
        return texel_weights[texel_index(i >> 1, j >> 1) + part_of(i, j)];
    }

    /// The variance of directions per axis, from the length of their mean.
    template <class Real>
    NUSSELT_INLINE Real variance_of(const Vec3<Real>& mean_direction) const noexcept {
        return multiply_add(Real(T(1) / T(3)), max(Real(1) - dot(mean_direction, mean_direction), Real(0)),
                            Real(texel_variance));
    }

    /// The interpolated lookups in a texel, averaged over channels.
    /// \tparam Real T, or a pack of texels.
    template <class Real = T>
    NUSSELT_HD detail::BilinearTexel<Real> texel_at(const detail::index_t<Real>& i,
                                                    const detail::index_t<Real>& j) const noexcept {
        constexpr int kLanes = RealTraits<Real>::kLanes;
        using Index = detail::index_t<Real>;
        const auto columns = detail::places<Real>(i, Index(0), 0);
        const auto rows = detail::places<Real>(j, Index(0), 0);
        T value[9][kLanes];
        for (int lane = 0; lane < kLanes; ++lane)
            for (int k = 0; k < 9; ++k)
                value[k][lane] = mean_of_channels(
                    radiance.at(columns.lane[lane] + k % 3 - 1, rows.lane[lane] + k / 3 - 1));
        detail::BilinearTexel<Real> texel;
        for (int k = 0; k < 9; ++k) texel.value[k / 3][k % 3] = detail::load_lanes<Real>(value[k]);
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

/// Fills the weights of texels and the mean radiance of cells.
template <class T, int n>
NUSSELT_HD inline void fill_texels(EnvironmentMap<T, n>& map, T* weights) noexcept {
    using Sum = std::conditional_t<std::is_same_v<T, float>, double, T>;
    const int texels = map.radiance.size / n;
    for (int cell = 0; cell < n * n; ++cell) {
        Vec3<Sum> sum{Sum(0), Sum(0), Sum(0)};
        for (int k = 0; k < texels * texels; ++k) {
            const int i = cell % n * texels + k % texels;
            const int j = cell / n * texels + k / texels;
            const Vec3<T> mean = mean_over_texel(map.radiance, i, j);
            weights[map.texel_index(i >> 1, j >> 1) + map.part_of(i, j)] = mean_of_channels(map.scale * mean);
            sum += broadcast<Sum>(mean);
        }
        const auto share = static_cast<Sum>(texels * texels);
        map.mean[0][cell] = static_cast<T>(sum.x / share);
        map.mean[1][cell] = static_cast<T>(sum.y / share);
        map.mean[2][cell] = static_cast<T>(sum.z / share);
    }
}

/// Writes the element that four parts make to part k of the next element, whose numbers are `stride` apart.
template <class T>
NUSSELT_HD inline void unite_parts(const T* weight, const Vec3<T>* direction, T* next, int stride) noexcept {
    const T total = (weight[0] + weight[1]) + (weight[2] + weight[3]);
    const T inverse = total > T(0) ? T(1) / total : T(0);
    Vec3<T> sum{T(0), T(0), T(0)};
    for (int k = 0; k < 4; ++k) sum += (inverse * weight[k]) * direction[k];
    next[0] = T(0.25) * total;
    next[stride] = sum.x;
    next[2 * stride] = sum.y;
    next[3 * stride] = sum.z;
}

/// Fills all elements and cells from the weights of texels.
template <class T, int n>
NUSSELT_HD inline void fill_elements(EnvironmentMap<T, n>& map, T* elements) noexcept {
    const PyramidShape& shape = map.shape;
    for (int level = 1; level < shape.levels; ++level) {
        const int size = shape.width_of(level);
        const T step = T(1) / static_cast<T>(2 * size);
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i) {
                const T* const weight = level == 1 ? map.texel_weights + map.texel_index(i, j)
                                                   : elements + map.element_index(level, i, j);
                Vec3<T> direction[4];
                for (int k = 0; k < 4; ++k) {
                    const Vec2<T> centre{(static_cast<T>(2 * i + k % 2) + T(0.5)) * step,
                                         (static_cast<T>(2 * j + k / 2) + T(0.5)) * step};
                    direction[k] = level == 1 ? octahedral_direction(centre)
                                              : Vec3<T>{weight[4 + k], weight[8 + k], weight[12 + k]};
                }
                if (level + 1 < shape.levels) {
                    T* const next = elements + map.element_index(level + 1, i >> 1, j >> 1);
                    unite_parts(weight, direction, next + map.part_of(i, j), 4);
                    continue;
                }
                T cell[4];
                unite_parts(weight, direction, cell, 1);
                map.weight[j * n + i] = cell[0];
                for (int axis = 0; axis < 3; ++axis) map.direction[axis][j * n + i] = cell[1 + axis];
            }
        }
    }
}

} // namespace detail

/// \tparam n        columns and rows of the lattice, 8 or 16.
/// \param  radiance of a size that is a power of two from 2 n to 2^14. Texels are finite and not negative, and at most
///                  a hundredth of the largest number; others are errors of the caller.
/// \param  storage  EnvironmentMap<T, n>::storage_size(radiance.size) numbers, which the map refers to: first those of
///                  grid 1, then those of grids 2 and above.
template <int n, class T>
NUSSELT_HD inline EnvironmentMap<T, n> make_environment_map(const OctahedralMap<T>& radiance,
                                                            T* storage) noexcept {
    T brightest = T(0);
    const int texels = radiance.size * radiance.size;
    for (int k = 0; k < texels; ++k) brightest = max(brightest, mean_of_channels(radiance.texel[k]));
    EnvironmentMap<T, n> map{radiance,
                             PyramidShape(n, radiance.size, radiance.size),
                             storage,
                             storage + texels,
                             brightest > T(0) ? reciprocal_power_of_two(brightest) : T(1),
                             kPi<T> / (T(3) * static_cast<T>(texels)),
                             {},
                             {},
                             {}};
    detail::fill_texels(map, storage);
    detail::fill_elements(map, storage + texels);
    return map;
}

NUSSELT_NAMESPACE_END
