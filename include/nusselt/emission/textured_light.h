#pragma once
/// All that sampling needs to know about a polygon with a texture, prepared once per light: a lattice of n x n cells over
/// the texture, the pyramid below it, and how the outline of the polygon cuts the lattice.

#include <nusselt/core/trig.h>
#include <nusselt/emission/texture_pyramid.h>

NUSSELT_NAMESPACE_BEGIN

/// A convex part of a texture.
template <class T>
struct TexturePart {
    static constexpr int kMostCorners = 12;
    Vec2<T> corner[kMostCorners]; ///< texture coordinates, counter-clockwise
    int count;                    ///< 0 or at least 3

    /// Share of the texture.
    NUSSELT_HD T area() const noexcept {
        T doubled = T(0);
        for (int k = 2; k < count; ++k)
            doubled += max(det(corner[k - 1] - corner[0], corner[k] - corner[0]), T(0));
        return T(0.5) * doubled;
    }
};

/// The outline of a light in texture coordinates.
template <class T>
struct TextureOutline {
    static constexpr int kMostVertices = 8;
    Vec2<T> vertex[kMostVertices]; ///< convex, counter-clockwise, in [0, 1]^2
    int count;                     ///< 3 to kMostVertices

    NUSSELT_HD const Vec2<T>& end_of(int edge) const noexcept {
        return vertex[edge + 1 < count ? edge + 1 : 0];
    }

    /// Whether all of a rectangle is inside.
    /// \tparam Real T, or a pack of rectangles.
    template <class Real = T>
    NUSSELT_HD mask_t<Real> contains(const Vec2<Real>& low, const Vec2<Real>& high) const noexcept {
        mask_t<Real> inside(true);
        for (int k = 0; k < count; ++k) {
            const Vec2<T> along = end_of(k) - vertex[k];
            const Vec2<Real> outermost{along.y > T(0) ? high.x : low.x, along.x > T(0) ? low.y : high.y};
            inside =
                inside & (det(broadcast<Real>(along), outermost - broadcast<Real>(vertex[k])) >= Real(0));
        }
        return inside;
    }

    /// The part inside of a rectangle.
    NUSSELT_HD TexturePart<T> part_in(const Vec2<T>& low, const Vec2<T>& high) const noexcept {
        TexturePart<T> part{{}, count};
        for (int k = 0; k < count; ++k) part.corner[k] = vertex[k];
        part = cut<0>(part, T(1), low.x);
        part = cut<0>(part, T(-1), high.x);
        part = cut<1>(part, T(1), low.y);
        return cut<1>(part, T(-1), high.y);
    }

private:
    /// The part where sign times a coordinate is at least sign times the limit.
    template <int axis>
    NUSSELT_HD static TexturePart<T> cut(const TexturePart<T>& whole, T sign, T limit) noexcept {
        TexturePart<T> result{{}, 0};
        const auto add = [&](const Vec2<T>& p) {
            if (result.count < TexturePart<T>::kMostCorners) result.corner[result.count++] = p;
        };
        for (int k = 0; k < whole.count; ++k) {
            const Vec2<T>& a = whole.corner[k];
            const Vec2<T>& b = whole.corner[k + 1 < whole.count ? k + 1 : 0];
            const T from = sign * ((axis == 0 ? a.x : a.y) - limit);
            const T to = sign * ((axis == 0 ? b.x : b.y) - limit);
            if (from >= T(0)) add(a);
            if ((from < T(0) && to > T(0)) || (from > T(0) && to < T(0))) {
                Vec2<T> crossing = a + (from / (from - to)) * (b - a);
                (axis == 0 ? crossing.x : crossing.y) = limit;
                add(crossing);
            }
        }
        if (result.count < 3) result.count = 0;
        return result;
    }
};

namespace detail {

/// A uniform point of a part: the triangle of a fan by u.x, as in PolygonArea.
template <class T>
NUSSELT_HD inline Vec2<T> sample_part(const TexturePart<T>& part, const Vec2<T>& u) noexcept {
    const Vec2<T>& corner = part.corner[0];
    T rest = u.x * T(2) * part.area();
    Vec2<T> a{T(0), T(0)}, b{T(0), T(0)};
    T along = T(0);
    for (int k = 2; k < part.count; ++k) {
        const Vec2<T> from = part.corner[k - 1] - corner;
        const Vec2<T> to = part.corner[k] - corner;
        const T doubled = det(from, to);
        if (!(doubled > T(0)) || rest < T(0)) continue;
        a = from;
        b = to;
        along = min(rest / doubled, T(1));
        rest = rest < doubled ? T(-1) : rest - doubled;
    }
    const T root = sqrt(u.y);
    return corner + (root * (T(1) - along)) * a + (root * along) * b;
}

/// What sample_part() undoes.
template <class T>
NUSSELT_HD inline Vec2<T> invert_part(const TexturePart<T>& part, const Vec2<T>& at) noexcept {
    const Vec2<T> q = at - part.corner[0];
    const T total = T(2) * part.area();
    T before = T(0);
    Vec2<T> u{T(0), T(0)};
    for (int k = 2; k < part.count; ++k) {
        const Vec2<T> from = part.corner[k - 1] - part.corner[0];
        const Vec2<T> to = part.corner[k] - part.corner[0];
        const T doubled = det(from, to);
        if (!(doubled > T(0))) continue;
        const T towards_from = max(det(q, to) / doubled, T(0));
        const T towards_to = max(det(from, q) / doubled, T(0));
        const T sum = towards_from + towards_to;
        u = {below_one((before + (sum > T(0) ? towards_to / sum : T(0)) * doubled) / total),
             below_one(sum * sum)};
        if (towards_from > T(0)) break;
        before += doubled;
    }
    return u;
}

} // namespace detail

/// A piece of the outline inside of one cell.
template <class T>
struct OutlinePiece {
    int cell, edge;
    T begin, end; ///< positions along the edge, from 0 to 1
};

/// An interval of a line of the lattice that is inside of the outline.
template <class T>
struct LatticeChord {
    T low, high; ///< texture coordinates along the line; equal if it misses the outline
};

/// \tparam T float, double or long double.
/// \tparam n columns and rows of the lattice: 8 or 16. Cell (i, j) has the index j * n + i.
template <class T, int n>
struct TexturedLight {
    static_assert(n == 8 || n == 16, "lanes of a pack are neighbouring cells of a row");
    static constexpr int kCells = n * n;
    /// Each line between cells cuts a convex outline at most twice.
    static constexpr int kMostPieces = 4 * (n - 1) + TextureOutline<T>::kMostVertices;

    TexturePyramid<T> pyramid;
    TextureOutline<T> outline;

    // Per cell, over the part inside of the outline.
    T mean[3][kCells];   ///< mean radiance per channel [W/(sr m^2)]
    T weight[kCells];    ///< mean over channels of mean[]; 0 only if all of the cell is black
    T variation[kCells]; ///< squared coefficient of variation of the weights of texels
    T cover[kCells];     ///< the share of the cell inside of the outline: 1 exactly if all of it is

    LatticeChord<T> column_line[n + 1]; ///< on the lines x = i / n
    LatticeChord<T> row_line[n + 1];    ///< on the lines y = j / n
    OutlinePiece<T> piece[kMostPieces]; ///< of edges that are not on lines of the lattice
    int pieces;

    /// Where cell boundary i is.
    NUSSELT_HD static constexpr T line(int i) noexcept { return static_cast<T>(i) / static_cast<T>(n); }

    /// The share of the texture that the light covers.
    NUSSELT_HD T covered() const noexcept {
        T sum = T(0);
        for (int c = 0; c < kCells; ++c) sum += cover[c];
        return sum / T(kCells);
    }

    /// Mean radiance over the area of the light, per channel [W/(sr m^2)].
    NUSSELT_HD Vec3<T> mean_radiance() const noexcept {
        Vec3<T> sum{T(0), T(0), T(0)};
        T area = T(0);
        for (int c = 0; c < kCells; ++c) {
            sum += cover[c] * Vec3<T>{mean[0][c], mean[1][c], mean[2][c]};
            area += cover[c];
        }
        return area > T(0) ? sum / area : sum;
    }

    /// What one side of the light emits, per channel [W].
    /// \param texture_area TexturePlane::area() [m^2].
    NUSSELT_HD Vec3<T> flux(const T& texture_area) const noexcept {
        return (kPi<T> * texture_area * covered()) * mean_radiance();
    }
};

namespace detail {

/// The chord of a line where one coordinate has a value.
template <int axis, class T>
NUSSELT_HD inline LatticeChord<T> chord_at(const TextureOutline<T>& outline, const T& position) noexcept {
    const auto across = [](const Vec2<T>& p) { return axis == 0 ? p.x : p.y; };
    const auto along = [](const Vec2<T>& p) { return axis == 0 ? p.y : p.x; };
    LatticeChord<T> chord{T(2), T(-1)};
    const auto add = [&](const T& x) { chord = {min(chord.low, x), max(chord.high, x)}; };
    for (int k = 0; k < outline.count; ++k) {
        const Vec2<T>& a = outline.vertex[k];
        const Vec2<T>& b = outline.end_of(k);
        const T from = across(a) - position;
        const T to = across(b) - position;
        if (from == T(0)) add(along(a));
        if ((from < T(0) && to > T(0)) || (from > T(0) && to < T(0)))
            add(along(a) + from / (from - to) * (along(b) - along(a)));
    }
    return chord.low < chord.high ? chord : LatticeChord<T>{T(0), T(0)};
}

/// Cuts the outline at the lines of the lattice.
template <class T, int n>
NUSSELT_HD inline void cut_outline(TexturedLight<T, n>& light) noexcept {
    light.pieces = 0;
    for (int k = 0; k < light.outline.count; ++k) {
        const Vec2<T> a = light.outline.vertex[k];
        const Vec2<T> d = light.outline.end_of(k) - a;
        // The chord of a line of the lattice has the edges that lie on it.
        const auto is_line = [](const T& x) { return floor(x * T(n)) == x * T(n); };
        if ((d.x == T(0) && is_line(a.x)) || (d.y == T(0) && is_line(a.y))) continue;

        // The positions where the edge meets lines, in increasing order.
        T cut[2 * n + 4];
        int cuts = 0;
        const auto insert = [&](const T& position) {
            if (!(position > T(0) && position < T(1))) return;
            int slot = cuts++;
            for (; slot > 0 && cut[slot - 1] > position; --slot) cut[slot] = cut[slot - 1];
            cut[slot] = position;
        };
        for (int i = 0; i <= n; ++i) {
            if (d.x != T(0)) insert((light.line(i) - a.x) / d.x);
            if (d.y != T(0)) insert((light.line(i) - a.y) / d.y);
        }
        cut[cuts] = T(1);
        T begin = T(0);
        for (int i = 0; i <= cuts; ++i) {
            const T middle = T(0.5) * (begin + cut[i]);
            const int column = clamp_index(floor_to_int((a.x + middle * d.x) * T(n)), n);
            const int row = clamp_index(floor_to_int((a.y + middle * d.y) * T(n)), n);
            if (cut[i] > begin && light.pieces < light.kMostPieces)
                light.piece[light.pieces++] = {row * n + column, k, begin, cut[i]};
            begin = cut[i];
        }
    }
}

/// Finds the means of a cell and writes its part of the finest grid.
template <class Filter, class T, int n>
NUSSELT_HD inline void fill_cell(TexturedLight<T, n>& light, const TextureView<T>& texture, int column,
                                 int row, T* weight) noexcept {
    // Sums over thousands of texels.
    using Sum = std::conditional_t<std::is_same_v<T, float>, double, T>;
    const PyramidShape& shape = light.pyramid.shape;
    const int c = row * n + column;
    const Vec2<T> low{light.line(column), light.line(row)};
    const Vec2<T> high{light.line(column + 1), light.line(row + 1)};
    const bool whole = light.outline.contains(low, high);
    const TexturePart<T> part = light.outline.part_in(low, high);
    const T share = part.area() * T(light.kCells);
    // A part is never as large as the cell.
    light.cover[c] = whole ? T(1) : below_one(share);

    const int columns = shape.width_of(0) / n;
    const int rows = shape.height_of(0) / n;
    const Vec2<T> step{T(1) / static_cast<T>(shape.width_of(0)), T(1) / static_cast<T>(shape.height_of(0))};
    Vec3<Sum> sum{Sum(0), Sum(0), Sum(0)};
    Sum squares = Sum(0);
    Sum area = Sum(0);
    for (int j = row * rows; j < (row + 1) * rows; ++j) {
        for (int i = column * columns; i < (column + 1) * columns; ++i) {
            const Vec2<T> from{static_cast<T>(i) * step.x, static_cast<T>(j) * step.y};
            const Vec2<T> to{static_cast<T>(i + 1) * step.x, static_cast<T>(j + 1) * step.y};
            T inside = T(1);
            if (!whole && !light.outline.contains(from, to))
                inside = light.outline.part_in(from, to).area() / (step.x * step.y);
            const Vec3<T> radiance = mean_radiance<Filter>(texture, from, to);
            const T mean = mean_of_channels(radiance);
            weight[shape.index(0, i, j)] = inside * mean;
            sum += Sum(inside) * broadcast<Sum>(radiance);
            squares += Sum(inside) * Sum(mean) * Sum(mean);
            area += Sum(inside);
        }
    }
    const Sum inverse = area > Sum(0) ? Sum(1) / area : Sum(0);
    const Sum mean = inverse * mean_of_channels(sum);
    light.mean[0][c] = static_cast<T>(inverse * sum.x);
    light.mean[1][c] = static_cast<T>(inverse * sum.y);
    light.mean[2][c] = static_cast<T>(inverse * sum.z);
    light.weight[c] = static_cast<T>(mean);
    light.variation[c] =
        mean > Sum(0) ? static_cast<T>(max(inverse * squares / (mean * mean) - Sum(1), Sum(0))) : T(0);
    // Techniques for polygons have at most eight vertices: such a part is always sampled by texels.
    if (part.count > 8) light.variation[c] = std::numeric_limits<T>::max();
}

} // namespace detail

/// \tparam Filter  NearestFilter or BilinearFilter: how the renderer looks up radiance.
/// \tparam n       columns and rows of the lattice, 8 or 16.
/// \param texture  only read here.
/// \param vertices of the light in texture coordinates, in [0, 1]^2; convex, in either winding.
/// \param count    3 to 8 of them.
/// \param storage  PyramidShape(n, texture.width, texture.height).size numbers, which the light refers to.
/// Negative, infinite and NaN texels are errors of the caller: what is sampled then means nothing.
template <class Filter, int n, class T>
NUSSELT_HD inline TexturedLight<T, n>
make_textured_light(const TextureView<T>& texture, const Vec2<T>* vertices, int count, T* storage) noexcept {
    TexturedLight<T, n> light{
        {PyramidShape(n, texture.width, texture.height), storage}, {}, {}, {}, {}, {}, {}, {}, {}, 0};
    light.outline.count = count;
    T doubled_area = T(0);
    for (int k = 2; k < count; ++k)
        doubled_area += det(vertices[k - 1] - vertices[0], vertices[k] - vertices[0]);
    for (int k = 0; k < count; ++k)
        light.outline.vertex[k] = vertices[doubled_area < T(0) ? count - 1 - k : k];

    for (int i = 0; i <= n; ++i) {
        light.column_line[i] = detail::chord_at<0>(light.outline, light.line(i));
        light.row_line[i] = detail::chord_at<1>(light.outline, light.line(i));
    }
    detail::cut_outline(light);
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column)
            detail::fill_cell<Filter>(light, texture, column, row, storage);
    fill_pyramid(light.pyramid.shape, storage);
    return light;
}

/// The light that has all of the texture.
template <class Filter, int n, class T>
NUSSELT_HD inline TexturedLight<T, n> make_textured_rectangle(const TextureView<T>& texture,
                                                              T* storage) noexcept {
    const Vec2<T> corners[4] = {{T(0), T(0)}, {T(1), T(0)}, {T(1), T(1)}, {T(0), T(1)}};
    return make_textured_light<Filter, n>(texture, corners, 4, storage);
}

NUSSELT_NAMESPACE_END
