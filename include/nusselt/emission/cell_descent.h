#pragma once
/// How samples descend from a cell of the lattice to a texel.

#include <nusselt/emission/cell_lattice.h>

NUSSELT_NAMESPACE_BEGIN

/// Whether a sampler finds a texel, and how likely it was.
template <class T>
struct TexelChoice {
    int i, j;      ///< column and row in the finest grid
    T probability; ///< given the cell; 0 if there is no texel to choose
    Vec2<T> u;     ///< random numbers that are left, in [0, 1)^2
};

namespace detail {

/// Weights of the parts of an element, in the order (0, 0), (1, 0), (0, 1), (1, 1). Those that do not exist weigh nothing.
template <class T>
struct ElementParts {
    int columns, rows; ///< 1 or 2
    T weight[4];

    NUSSELT_HD T column(int i) const noexcept { return weight[i] + weight[2 + i]; }
};

/// The index of the first part whose end is above u total, and what is left of u.
template <class T>
NUSSELT_HD inline int choose_of_two(const T& first, const T& second, T& u) noexcept {
    const T target = u * (first + second);
    const int chosen = (second > T(0)) & (target >= first);
    const T rest = target - (chosen != 0 ? first : T(0));
    u = below_one(rest / (chosen != 0 ? second : max(first, std::numeric_limits<T>::min())));
    return chosen;
}

/// What choose_of_two() undoes.
template <class T>
NUSSELT_HD inline T unite_of_two(const T& first, const T& second, int chosen, const T& u) noexcept {
    const T total = first + second;
    return total > T(0) ? below_one((chosen != 0 ? first + u * second : u * first) / total) : T(0);
}

/// Descends to a texel. With one random number per direction, the order of texels in each direction is kept.
/// \param parts_of(level, i, j) ElementParts of the element (i, j) of a grid.
template <class T, class PartsOf>
NUSSELT_HD inline TexelChoice<T> descend(const PyramidShape& shape, int column, int row, const Vec2<T>& u,
                                         const PartsOf& parts_of) noexcept {
    TexelChoice<T> choice{column, row, T(1), u};
    for (int level = shape.levels - 1; level > 0; --level) {
        const ElementParts<T> parts = parts_of(level, choice.i, choice.j);
        const T left = parts.column(0), right = parts.column(1);
        const int i = choose_of_two(left, right, choice.u.x);
        const int j = choose_of_two(parts.weight[i], parts.weight[2 + i], choice.u.y);
        const T total = left + right;
        choice.probability = total > T(0) ? choice.probability * parts.weight[2 * j + i] / total : T(0);
        choice.i = parts.columns * choice.i + i;
        choice.j = parts.rows * choice.j + j;
    }
    return choice;
}

/// The probability of a texel given its cell, and the random numbers that lead there.
/// \param choice with the texel, and with the random numbers inside of it.
template <class T, class PartsOf>
NUSSELT_HD inline TexelChoice<T> ascend(const PyramidShape& shape, TexelChoice<T> choice,
                                        const PartsOf& parts_of) noexcept {
    choice.probability = T(1);
    for (int level = 1; level < shape.levels; ++level) {
        const int columns = shape.columns_of(level);
        const int rows = shape.rows_of(level);
        const int i = choice.i & (columns - 1);
        const int j = choice.j & (rows - 1);
        choice.i >>= columns - 1;
        choice.j >>= rows - 1;
        const ElementParts<T> parts = parts_of(level, choice.i, choice.j);
        const T left = parts.column(0), right = parts.column(1);
        choice.u.x = unite_of_two(left, right, i, choice.u.x);
        choice.u.y = unite_of_two(parts.weight[i], parts.weight[2 + i], j, choice.u.y);
        const T total = left + right;
        choice.probability = total > T(0) ? choice.probability * parts.weight[2 * j + i] / total : T(0);
    }
    return choice;
}

/// The parts of element (i, j) of a grid, weighed by what they emit.
template <class T>
NUSSELT_HD inline ElementParts<T> emitting_parts(const TexturePyramid<T>& pyramid, int level, int i,
                                                 int j) noexcept {
    const PyramidShape& shape = pyramid.shape;
    const int columns = shape.columns_of(level);
    const int rows = shape.rows_of(level);
    const T* first = pyramid.weight + shape.index(level - 1, columns * i, rows * j);
    const T* second = first + (rows == 2 ? shape.width_of(level - 1) : 0);
    ElementParts<T> parts{columns, rows, {first[0], first[columns - 1], second[0], second[columns - 1]}};
    if (columns == 1) parts.weight[1] = parts.weight[3] = T(0);
    if (rows == 1) parts.weight[2] = parts.weight[3] = T(0);
    return parts;
}

/// The integrand of projected solid angles over a texture, up to a factor: zero below the horizon.
template <class Real, class T>
NUSSELT_INLINE Real relative_cosine(const TexturePlane<T>& plane, const Real& x, const Real& y) noexcept {
    const auto at = [&](const T& corner, const T& side_x, const T& side_y) {
        return multiply_add(x, Real(side_x), multiply_add(y, Real(side_y), Real(corner)));
    };
    const Vec3<Real> p{at(plane.corner.x, plane.side_x.x, plane.side_y.x),
                       at(plane.corner.y, plane.side_x.y, plane.side_y.y),
                       at(plane.corner.z, plane.side_x.z, plane.side_y.z)};
    const Real squared = max(dot(p, p), Real(kTiny<T>));
    return (max(p.z, Real(0)) / squared) / squared;
}

} // namespace detail

/// Texels in proportion to what they emit. Probabilities are ratios of the finest to the coarsest grid: the density is known
/// without a walk through the grids in between.
struct DescentByRadiance {
    template <class T>
    NUSSELT_HD static TexelChoice<T> choose(const TexturePyramid<T>& pyramid, const TexturePlane<T>&,
                                            int column, int row, const Vec2<T>& u) noexcept {
        TexelChoice<T> choice = detail::descend(pyramid.shape, column, row, u, [&](int level, int i, int j) {
            return detail::emitting_parts(pyramid, level, i, j);
        });
        choice.probability = probability_in(pyramid, column, row, choice.i, choice.j);
        return choice;
    }
    template <class T>
    NUSSELT_HD static T probability(const TexturePyramid<T>& pyramid, const TexturePlane<T>&, int i,
                                    int j) noexcept {
        const PyramidShape& shape = pyramid.shape;
        const int columns = shape.width_of(0) / shape.cells;
        const int rows = shape.height_of(0) / shape.cells;
        return probability_in(pyramid, i / columns, j / rows, i, j);
    }
    /// \param choice with the texel, and with the random numbers inside of it.
    template <class T>
    NUSSELT_HD static Vec2<T> invert(const TexturePyramid<T>& pyramid, const TexturePlane<T>&,
                                     const TexelChoice<T>& choice) noexcept {
        return detail::ascend(
                   pyramid.shape, choice,
                   [&](int level, int i, int j) { return detail::emitting_parts(pyramid, level, i, j); })
            .u;
    }

private:
    template <class T>
    NUSSELT_HD static T probability_in(const TexturePyramid<T>& pyramid, int column, int row, int i,
                                       int j) noexcept {
        const PyramidShape& shape = pyramid.shape;
        const T cell = pyramid.at(shape.levels - 1, column, row);
        const auto texels = static_cast<T>(shape.width_of(0) * shape.height_of(0));
        const T per_cell = texels * (T(1) / static_cast<T>(shape.cells * shape.cells));
        return cell > T(0) ? pyramid.at(0, i, j) / (cell * per_cell) : T(0);
    }
};

/// Texels in proportion to what they emit times the cosine over the squared distance, at each grid by the rule for the mean
/// of a quadratic function from the centre (2/3) and the corners (1/12 each). An element keeps a weight as long as one of
/// its corners is above the horizon.
struct DescentByProduct {
    template <class T>
    NUSSELT_HD static TexelChoice<T> choose(const TexturePyramid<T>& pyramid, const TexturePlane<T>& plane,
                                            int column, int row, const Vec2<T>& u) noexcept {
        return detail::descend(pyramid.shape, column, row, u, [&](int level, int i, int j) {
            return lit_parts(pyramid, plane, level, i, j);
        });
    }
    template <class T>
    NUSSELT_HD static T probability(const TexturePyramid<T>& pyramid, const TexturePlane<T>& plane, int i,
                                    int j) noexcept {
        return walk(pyramid, plane, {i, j, T(1), {T(0), T(0)}}).probability;
    }
    /// \copydoc DescentByRadiance::invert
    template <class T>
    NUSSELT_HD static Vec2<T> invert(const TexturePyramid<T>& pyramid, const TexturePlane<T>& plane,
                                     const TexelChoice<T>& choice) noexcept {
        return walk(pyramid, plane, choice).u;
    }

private:
    template <class T>
    NUSSELT_HD static TexelChoice<T> walk(const TexturePyramid<T>& pyramid, const TexturePlane<T>& plane,
                                          const TexelChoice<T>& choice) noexcept {
        return detail::ascend(pyramid.shape, choice, [&](int level, int i, int j) {
            return lit_parts(pyramid, plane, level, i, j);
        });
    }

    template <class T>
    NUSSELT_HD static detail::ElementParts<T> lit_parts(const TexturePyramid<T>& pyramid,
                                                        const TexturePlane<T>& plane, int level, int i,
                                                        int j) noexcept {
        using Lanes = detail::CellLanes<T>;
        detail::ElementParts<T> parts = detail::emitting_parts(pyramid, level, i, j);
        const PyramidShape& shape = pyramid.shape;
        const T width = T(1) / static_cast<T>(shape.width_of(level));
        const T height = T(1) / static_cast<T>(shape.height_of(level));
        // Positions in half parts: nine corners, then four centres. Where there is one part only, the others weigh nothing.
        const T step_x = width / static_cast<T>(2 * parts.columns);
        const T step_y = height / static_cast<T>(2 * parts.rows);
        static constexpr T kX[16] = {0, 2, 4, 0, 2, 4, 0, 2, 4, 1, 3, 1, 3, 0, 0, 0};
        static constexpr T kY[16] = {0, 0, 0, 2, 2, 2, 4, 4, 4, 1, 1, 3, 3, 0, 0, 0};
        T cosine[16];
        for (int k = 0; k < 16; k += Lanes::kCount) {
            using L = typename Lanes::Type;
            const L x = multiply_add(Lanes::load(kX + k), L(step_x), L(static_cast<T>(i) * width));
            const L y = multiply_add(Lanes::load(kY + k), L(step_y), L(static_cast<T>(j) * height));
            Lanes::store(cosine + k, detail::relative_cosine(plane, x, y));
        }
        for (int k = 0; k < 4; ++k) {
            const int corner = 3 * (k / 2) + k % 2;
            const T corners =
                (cosine[corner] + cosine[corner + 1]) + (cosine[corner + 3] + cosine[corner + 4]);
            parts.weight[k] *= T(2) / T(3) * cosine[9 + k] + T(1) / T(12) * corners;
        }
        return parts;
    }
};

NUSSELT_NAMESPACE_END
