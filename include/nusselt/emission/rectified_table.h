#pragma once
/// Tables of radiance by direction, in coordinates in which a rectangle is an axis-aligned window from wherever it is seen.
///
/// B. Bitterli, J. Novak, W. Jarosz 2015, Portal-Masked Environment Map Sampling, CGF 34(4), doi:10.1111/cgf.12674: in a frame
/// whose axes are those of the rectangle, alpha = atan(x / z) and beta = atan(y / z) of a direction. Deviations: texels weigh
/// their exact solid angle, sums are integers, and a table may cover a part of the hemisphere only.

#include <cmath>
#include <cstdint>

#include <nusselt/core/trig.h>
#include <nusselt/emission/texture.h>

NUSSELT_NAMESPACE_BEGIN

/// Slopes of directions next to the edge of a hemisphere, beyond which nothing is counted.
template <class T>
inline constexpr T kLargestSlope = power_of_two<T>(std::numeric_limits<T>::max_exponent / 4);

/// The directions (x, y, z) with slopes x / z and y / z in a rectangle, and z > 0.
template <class T>
struct RectifiedDomain {
    Vec2<T> low, high; ///< slopes within kLargestSlope, low < high in both components

    /// All directions with z > 0.
    NUSSELT_HD static constexpr RectifiedDomain hemisphere() noexcept {
        return {{-kLargestSlope<T>, -kLargestSlope<T>}, {kLargestSlope<T>, kLargestSlope<T>}};
    }
};

/// Sums over all texels (i, j) with i and j below those of an entry. Integers have exact differences, where those of floats
/// are wrong by percents next to a sun. Each of the three adds up to little more than 2^52 over the table.
///
/// The twin in GLSL, which has no 64-bit integers, subtracts pairs of 32-bit words with borrow: just as exact.
struct RectifiedSums {
    std::int64_t weight;      ///< of mean radiance times solid angle, rounded upwards
    std::int64_t square;      ///< of squared mean radiance times solid angle, rounded upwards
    std::int64_t solid_angle; ///< rounded upwards
};

/// How radiance varies within a few texels, such as those with the edge of a sun. Their weight stays what it is.
template <class T>
struct RefinedTexels {
    static constexpr int kParts = 8;              ///< of a texel, equally large along alpha and along beta
    static constexpr int kSize = kParts * kParts; ///< weights of a texel

    const std::int32_t* texel; ///< numbers of texels, row * width + column, increasing
    const T* weight;           ///< kSize of each texel, row by row, with a mean of 1: all above zero
    int count;                 ///< texels

    /// The weights of the parts of a texel, null if it has none.
    NUSSELT_HD const T* find(std::int32_t number) const noexcept {
        int first = 0, end = count;
        while (first < end) {
            const int middle = (first + end) / 2;
            if (texel[middle] < number)
                first = middle + 1;
            else
                end = middle;
        }
        return first < count && texel[first] == number ? weight + kSize * first : nullptr;
    }
};

/// Radiance in texels that are equally large in alpha and beta. All that it points to belongs to the caller.
/// \tparam T float, double or long double.
template <class T>
struct RectifiedTable {
    static constexpr int kMostTexels = 2048; ///< in each direction
    /// What sums add up to over the table, but for rounding.
    static constexpr T kWhole = power_of_two<T>(52);

    int width, height; ///< texels along alpha and beta, 1 to kMostTexels
    RectifiedDomain<T> domain;
    Vec2<T> angle_low;  ///< alpha and beta of domain.low [rad]
    Vec2<T> texel_size; ///< in alpha and beta [rad]
    T mean; ///< over the solid angle of the domain and over channels [W/(sr m^2)]; 0: all of it is black
    T mean_square; ///< of the radiance averaged over channels, over the squared mean: at least 1, or 0 if black
    const RectifiedSums* sums; ///< size(width, height) of them, at index(i, j)
    /// Sums like those of radiance per channel times solid angle [W/m^2], with rounding errors. WindowedPolygon takes null if all
    /// channels are equal.
    const Vec3<T>* colour;
    RefinedTexels<T> refined = {nullptr, nullptr, 0}; ///< refine_rectified_table() finds some

    /// Entries of each of the two arrays.
    NUSSELT_HD static constexpr int size(int width, int height) noexcept {
        return (width + 1) * (height + 1);
    }
    NUSSELT_HD int index(int i, int j) const noexcept { return j * (width + 1) + i; }

    /// Sums over texels first_i to end_i - 1, and first_j to end_j - 1: exact.
    NUSSELT_INLINE RectifiedSums sum(int first_i, int end_i, int first_j, int end_j) const noexcept {
        const RectifiedSums& a = sums[index(first_i, first_j)];
        const RectifiedSums& b = sums[index(end_i, first_j)];
        const RectifiedSums& c = sums[index(first_i, end_j)];
        const RectifiedSums& d = sums[index(end_i, end_j)];
        return {(d.weight - c.weight) - (b.weight - a.weight), (d.square - c.square) - (b.square - a.square),
                (d.solid_angle - c.solid_angle) - (b.solid_angle - a.solid_angle)};
    }
};

namespace detail {

/// Sums over millions of texels.
template <class T>
using TableNumber = std::conditional_t<std::is_same_v<T, float>, double, T>;

/// The solid angle of slopes below p and q, up to an additive function of p and one of q.
template <class T>
NUSSELT_HD inline T rectified_solid_angle_below(const T& p, const T& q) noexcept {
    return std::atan(p * q / sqrt(T(1) + p * p + q * q));
}

/// Solid angle per square radian of alpha and beta: (1 + p^2) (1 + q^2) / (1 + p^2 + q^2)^(3/2). Zero on edges of the
/// hemisphere and infinite in its corners, where it is finite for slopes within kLargestSlope.
template <class T>
NUSSELT_HD inline T rectified_jacobian(const T& p, const T& q) noexcept {
    const T squared = T(1) + p * p + q * q;
    return ((T(1) + p * p) / squared) * ((T(1) + q * q) / sqrt(squared));
}

/// The slopes of lines between texels, and what follows from them.
template <class T>
struct RectifiedGrid {
    int width, height;
    Vec2<T> low, high;             ///< slopes
    Vec2<T> angle_low, angle_high; ///< [rad]

    NUSSELT_HD RectifiedGrid(int columns, int rows, const Vec2<T>& slope_low,
                             const Vec2<T>& slope_high) noexcept
        : width(columns),
          height(rows),
          low(slope_low),
          high(slope_high),
          angle_low{std::atan(low.x), std::atan(low.y)},
          angle_high{std::atan(high.x), std::atan(high.y)} {}

    NUSSELT_HD Vec2<T> texel_size() const noexcept {
        return {(angle_high.x - angle_low.x) / static_cast<T>(width),
                (angle_high.y - angle_low.y) / static_cast<T>(height)};
    }
    /// Slopes at positions in texels.
    NUSSELT_HD T slope_x(const T& i) const noexcept {
        return slope(i, width, low.x, high.x, angle_low.x, texel_size().x);
    }
    NUSSELT_HD T slope_y(const T& j) const noexcept {
        return slope(j, height, low.y, high.y, angle_low.y, texel_size().y);
    }

    /// The solid angle of all texels [sr].
    NUSSELT_HD T solid_angle() const noexcept {
        const T exact = difference(low, high);
        if (exact > T(1e-6)) return exact;
        T sum = T(0);
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i) sum += solid_angle(i, j);
        return sum;
    }

    /// The solid angle of a texel [sr].
    NUSSELT_HD T solid_angle(int column, int row) const noexcept {
        const T i = static_cast<T>(column);
        const T j = static_cast<T>(row);
        const T exact = difference({slope_x(i), slope_y(j)}, {slope_x(i + T(1)), slope_y(j + T(1))});
        // Tiny differences are lost to rounding. There, the integral of the Jacobian is that of a quadratic function.
        if (exact > T(1e-9)) return exact;
        const T corners =
            (jacobian(i, j) + jacobian(i + T(1), j)) + (jacobian(i, j + T(1)) + jacobian(i + T(1), j + T(1)));
        const Vec2<T> size = texel_size();
        return (T(2) / T(3) * jacobian(i + T(0.5), j + T(0.5)) + T(1) / T(12) * corners) * (size.x * size.y);
    }

private:
    NUSSELT_HD static T slope(const T& position, int count, const T& from, const T& to, const T& angle_from,
                              const T& step) noexcept {
        if (!(position > T(0))) return from;
        if (!(position < static_cast<T>(count))) return to;
        return min(max(T(std::tan(angle_from + position * step)), from), to);
    }
    NUSSELT_HD T jacobian(const T& i, const T& j) const noexcept {
        return rectified_jacobian(slope_x(i), slope_y(j));
    }
    NUSSELT_HD static T difference(const Vec2<T>& from, const Vec2<T>& to) noexcept {
        return (rectified_solid_angle_below(to.x, to.y) - rectified_solid_angle_below(from.x, to.y)) -
               (rectified_solid_angle_below(to.x, from.y) - rectified_solid_angle_below(from.x, from.y));
    }
};

/// Radiance that sums can hold: negative and NaN count as black, and there is a largest one.
template <class T>
NUSSELT_HD inline Vec3<T> storable(const Vec3<T>& radiance) noexcept {
    constexpr T kLargest = power_of_two<T>(std::numeric_limits<T>::max_exponent / 4 * 3);
    const auto within = [](const T& x) { return min(max(x, T(0)), kLargest); };
    return {within(radiance.x), within(radiance.y), within(radiance.z)};
}

/// The mean over lookups in a texel or a part of one, weighted by solid angle.
/// \param i, j, size lower corner and side of the square of lookups, in texels
template <class T, class Radiance>
NUSSELT_HD inline Vec3<T> mean_of_lookups(const RectifiedGrid<TableNumber<T>>& grid, const TableNumber<T>& i,
                                          const TableNumber<T>& j, const TableNumber<T>& size, int lookups,
                                          const Radiance& radiance) noexcept {
    using Sum = TableNumber<T>;
    Vec3<Sum> sum{Sum(0), Sum(0), Sum(0)};
    Sum weights = Sum(0);
    for (int l = 0; l < lookups; ++l) {
        const Sum q = grid.slope_y(j + size * ((static_cast<Sum>(l) + Sum(0.5)) / static_cast<Sum>(lookups)));
        for (int k = 0; k < lookups; ++k) {
            const Sum p =
                grid.slope_x(i + size * ((static_cast<Sum>(k) + Sum(0.5)) / static_cast<Sum>(lookups)));
            const Sum weight = rectified_jacobian(p, q);
            const Sum z = Sum(1) / sqrt(Sum(1) + p * p + q * q);
            const Vec3<T> direction{static_cast<T>(p * z), static_cast<T>(q * z), static_cast<T>(z)};
            sum += weight * broadcast<Sum>(storable(radiance(direction)));
            weights += weight;
        }
    }
    const Vec3<Sum> mean = sum / weights;
    return {static_cast<T>(mean.x), static_cast<T>(mean.y), static_cast<T>(mean.z)};
}

} // namespace detail

/// \param radiance(direction) [W/(sr m^2)] per channel in a unit direction of the domain: a Vec3<T>. Negative and NaN count as
///                 black, and what exceeds 2^96 (float) as 2^96.
/// \param width, height texels along alpha and beta, 1 to RectifiedTable<T>::kMostTexels.
/// \param lookups  in each direction per texel, at least 1: their mean is that of the texel. What all of them miss can be
///                 missed by samples, unless a neighbouring texel is lit: no texel weighs less than a thousandth of a neighbour.
/// \param sums, colour RectifiedTable<T>::size(width, height) entries each, which the table refers to.
template <class T, class Radiance>
NUSSELT_HD inline RectifiedTable<T>
make_rectified_table(const Radiance& radiance, const RectifiedDomain<T>& domain, int width, int height,
                     int lookups, RectifiedSums* sums, Vec3<T>* colour) noexcept {
    using Sum = detail::TableNumber<T>;
    constexpr Sum kWhole = power_of_two<Sum>(52);
    const detail::RectifiedGrid<Sum> grid(width, height, broadcast<Sum>(domain.low),
                                          broadcast<Sum>(domain.high));
    const auto index = [&](int i, int j) { return j * (width + 1) + i; };
    const auto quantised = [](const Sum& x) { return static_cast<std::int64_t>(std::ceil(x)); };

    // Means go where sums will be. Their squares have to be in range.
    const Sum whole_solid_angle = grid.solid_angle();
    Sum largest = Sum(0);
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            const Vec3<T> mean = detail::mean_of_lookups<T>(grid, static_cast<Sum>(i), static_cast<Sum>(j),
                                                            Sum(1), lookups, radiance);
            colour[index(i + 1, j + 1)] = mean;
            sums[index(i + 1, j + 1)].solid_angle =
                quantised(grid.solid_angle(i, j) / whole_solid_angle * kWhole);
            largest = max(largest, static_cast<Sum>(mean_of_channels(mean)));
        }
    }
    const Sum inverse = largest > Sum(0) ? Sum(1) / largest : Sum(0);
    const auto weight_of = [&](int column, int row) {
        Sum neighbour = Sum(0);
        for (int j = row - 1; j <= row + 1; ++j)
            for (int i = column - 1; i <= column + 1; ++i)
                if (i >= 0 && i < width && j >= 0 && j < height)
                    neighbour =
                        max(neighbour, static_cast<Sum>(mean_of_channels(colour[index(i + 1, j + 1)])));
        const Sum own = static_cast<Sum>(mean_of_channels(colour[index(column + 1, row + 1)]));
        return inverse * max(own, Sum(1e-3) * neighbour);
    };
    const auto share_of = [&](int i, int j) {
        return static_cast<Sum>(sums[index(i + 1, j + 1)].solid_angle) / kWhole;
    };
    Sum mean = Sum(0);
    Sum mean_square = Sum(0);
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            const Sum weight = weight_of(i, j);
            mean += weight * share_of(i, j);
            mean_square += weight * weight * share_of(i, j);
        }
    }

    const Sum per_weight = mean > Sum(0) ? kWhole / mean : Sum(0);
    const Sum per_square = mean_square > Sum(0) ? kWhole / mean_square : Sum(0);
    for (int i = 0; i <= width; ++i) sums[index(i, 0)] = {0, 0, 0};
    for (int j = 0; j < height; ++j) {
        sums[index(0, j + 1)] = {0, 0, 0};
        RectifiedSums row{0, 0, 0};
        for (int i = 0; i < width; ++i) {
            const Sum weight = weight_of(i, j);
            const Sum share = share_of(i, j);
            row.weight += quantised(weight * share * per_weight);
            row.square += quantised(weight * weight * share * per_square);
            row.solid_angle += sums[index(i + 1, j + 1)].solid_angle;
            const RectifiedSums& below = sums[index(i + 1, j)];
            sums[index(i + 1, j + 1)] = {below.weight + row.weight, below.square + row.square,
                                         below.solid_angle + row.solid_angle};
        }
    }
    const RectifiedTable<T> table{width,
                                  height,
                                  domain,
                                  {static_cast<T>(grid.angle_low.x), static_cast<T>(grid.angle_low.y)},
                                  {static_cast<T>(grid.texel_size().x), static_cast<T>(grid.texel_size().y)},
                                  static_cast<T>(mean * largest),
                                  static_cast<T>(mean > Sum(0) ? mean_square / (mean * mean) : Sum(0)),
                                  sums,
                                  colour};

    for (int i = 0; i <= width; ++i) colour[index(i, 0)] = {T(0), T(0), T(0)};
    const Sum per_solid_angle = whole_solid_angle / kWhole;
    for (int j = 0; j < height; ++j) {
        colour[index(0, j + 1)] = {T(0), T(0), T(0)};
        Vec3<Sum> row{Sum(0), Sum(0), Sum(0)};
        for (int i = 0; i < width; ++i) {
            const std::int64_t solid_angle = table.sum(i, i + 1, j, j + 1).solid_angle;
            row += (static_cast<Sum>(solid_angle) * per_solid_angle) *
                   broadcast<Sum>(colour[index(i + 1, j + 1)]);
            const Vec3<Sum> total = broadcast<Sum>(colour[index(i + 1, j)]) + row;
            colour[index(i + 1, j + 1)] = {static_cast<T>(total.x), static_cast<T>(total.y),
                                           static_cast<T>(total.z)};
        }
    }
    return table;
}

namespace detail {

/// The mean radiance of a texel over that of the table, from its sums.
template <class T>
NUSSELT_HD inline T relative_mean(const RectifiedTable<T>& table, int i, int j) noexcept {
    const RectifiedSums sums = table.sum(i, i + 1, j, j + 1);
    return sums.solid_angle > 0 ? static_cast<T>(sums.weight) / static_cast<T>(sums.solid_angle) : T(0);
}

/// Whether much of the light comes from a texel that differs from a neighbour by more than a factor of two.
template <class T>
NUSSELT_HD inline bool is_edge(const RectifiedTable<T>& table, int column, int row) noexcept {
    constexpr T kLeastShare = T(1e-4);
    const RectifiedSums sums = table.sum(column, column + 1, row, row + 1);
    if (!(static_cast<T>(sums.weight) > kLeastShare * RectifiedTable<T>::kWhole)) return false;
    T least = relative_mean(table, column, row);
    T largest = least;
    for (int j = row - 1; j <= row + 1; ++j) {
        for (int i = column - 1; i <= column + 1; ++i) {
            if (i < 0 || i >= table.width || j < 0 || j >= table.height) continue;
            least = min(least, relative_mean(table, i, j));
            largest = max(largest, relative_mean(table, i, j));
        }
    }
    return largest > T(2) * least;
}

} // namespace detail

/// Finds how the radiance varies within the texels where that matters most: those with at least 1e-4 of the light that differ
/// from a neighbour by more than a factor of two.
/// \param radiance as of make_rectified_table().
/// \param table    made by make_rectified_table(); it refers to texel and weight afterwards.
/// \param most     refined texels, at most: those that come first. There are at most 10000.
/// \param texel, weight `most` entries, and RefinedTexels<T>::kSize times as many.
template <class T, class Radiance>
NUSSELT_HD inline void refine_rectified_table(const Radiance& radiance, RectifiedTable<T>& table, int most,
                                              std::int32_t* texel, T* weight) noexcept {
    using Refined = RefinedTexels<T>;
    using Sum = detail::TableNumber<T>;
    constexpr int kParts = Refined::kParts;
    constexpr int kLookups = 2;
    const detail::RectifiedGrid<Sum> grid(table.width, table.height, broadcast<Sum>(table.domain.low),
                                          broadcast<Sum>(table.domain.high));
    int count = 0;
    for (int j = 0; j < table.height; ++j) {
        for (int i = 0; i < table.width && count < most; ++i) {
            if (!detail::is_edge(table, i, j)) continue;
            T* const parts = weight + Refined::kSize * count;
            T largest = T(0);
            for (int k = 0; k < Refined::kSize; ++k) {
                const Sum size = Sum(1) / Sum(kParts);
                parts[k] = mean_of_channels(detail::mean_of_lookups<T>(
                    grid, static_cast<Sum>(i) + size * static_cast<Sum>(k % kParts),
                    static_cast<Sum>(j) + size * static_cast<Sum>(k / kParts), size, kLookups, radiance));
                largest = max(largest, parts[k]);
            }
            if (!(largest > T(0))) continue;
            // What lookups missed is still found.
            T sum = T(0);
            for (int k = 0; k < Refined::kSize; ++k) {
                parts[k] = max(parts[k] / largest, T(1e-3));
                sum += parts[k];
            }
            for (int k = 0; k < Refined::kSize; ++k) parts[k] *= T(Refined::kSize) / sum;
            texel[count++] = j * table.width + i;
        }
    }
    table.refined = {texel, weight, count};
}

NUSSELT_NAMESPACE_END
