#pragma once
/// How samples descend from a cell of the lattice to a texel.

#include <nusselt/emission/cell_lattice.h>
#include <nusselt/emission/lane_index.h>

NUSSELT_NAMESPACE_BEGIN

/// Whether a sampler finds a texel, and how likely it was.
template <class Real>
struct TexelChoice {
    detail::index_t<Real> i, j; ///< column and row in the finest grid
    Real probability;           ///< given the cell; 0 if there is no texel to choose
    Vec2<Real> u;               ///< random numbers that are left, in [0, 1)^2
};

namespace detail {

/// a where the mask is set, else b. Descents go either way at random: scalars do not branch.
template <class Real>
NUSSELT_INLINE Real select_of_two(const mask_t<Real>& mask, const Real& a, const Real& b) noexcept {
    if constexpr (RealTraits<Real>::kLanes == 1) {
        const Real both[2] = {b, a};
        return both[mask];
    } else {
        return select(mask, a, b);
    }
}

/// Weights of the parts of an element, in the order (0, 0), (1, 0), (0, 1), (1, 1). Those that do not exist weigh nothing.
template <class Real>
struct ElementParts {
    int columns, rows; ///< 1 or 2
    Real weight[4];

    NUSSELT_HD Real column(int i) const noexcept { return weight[i] + weight[2 + i]; }
    /// The weight in one of the columns of a row.
    NUSSELT_HD Real in_row(int row, const mask_t<Real>& second_column) const noexcept {
        return select_of_two(second_column, weight[2 * row + 1], weight[2 * row]);
    }
};

/// Whether the second part is chosen: the first one ends at or before u total. Leaves what is left of u.
template <class Real>
NUSSELT_INLINE mask_t<Real> choose_of_two(const Real& first, const Real& second, Real& u) noexcept {
    const Real target = u * (first + second);
    const auto chosen = (second > Real(0)) & (target >= first);
    const Real rest = select_of_two<Real>(chosen, target - first, target);
    constexpr scalar_t<Real> kLeast = std::numeric_limits<scalar_t<Real>>::min();
    u = below_one(rest / select_of_two<Real>(chosen, second, max(first, Real(kLeast))));
    return chosen;
}

/// What choose_of_two() undoes.
template <class Real>
NUSSELT_HD inline Real unite_of_two(const Real& first, const Real& second, const mask_t<Real>& chosen,
                                    const Real& u) noexcept {
    const Real total = first + second;
    return select(total > Real(0), below_one(select(chosen, first + u * second, u * first) / total), Real(0));
}

/// Descends to a texel. With one random number per direction, the order of texels in each direction is kept.
/// \param parts_of(level, i, j)  ElementParts of the element (i, j) of a grid.
/// \param enter(weight, total) is told the weight of each part that is chosen, and that of all parts of its element.
/// \returns the texel, without its probability.
template <class Real, class PartsOf, class Enter>
NUSSELT_HD inline TexelChoice<Real> descend(const PyramidShape& shape, const index_t<Real>& column,
                                            const index_t<Real>& row, const Vec2<Real>& u,
                                            const PartsOf& parts_of, const Enter& enter) noexcept {
    using Index = index_t<Real>;
    TexelChoice<Real> choice{column, row, Real(1), u};
    for (int level = shape.levels - 1; level > 0; --level) {
        const ElementParts<Real> parts = parts_of(level, choice.i, choice.j);
        const Real left = parts.column(0), right = parts.column(1);
        const mask_t<Real> i = choose_of_two(left, right, choice.u.x);
        const Real low = parts.in_row(0, i), high = parts.in_row(1, i);
        const mask_t<Real> j = choose_of_two(low, high, choice.u.y);
        enter(select_of_two<Real>(j, high, low), left + right);
        choice.i = Index(parts.columns) * choice.i + select_index<Real>(i, Index(1), Index(0));
        choice.j = Index(parts.rows) * choice.j + select_index<Real>(j, Index(1), Index(0));
    }
    return choice;
}

/// \copydoc descend
/// \returns the texel with its probability, the product of those of all steps.
template <class Real, class PartsOf>
NUSSELT_HD inline TexelChoice<Real> descend(const PyramidShape& shape, const index_t<Real>& column,
                                            const index_t<Real>& row, const Vec2<Real>& u,
                                            const PartsOf& parts_of) noexcept {
    Real probability = Real(1);
    TexelChoice<Real> choice =
        descend(shape, column, row, u, parts_of, [&](const Real& weight, const Real& total) {
            probability = select(total > Real(0), probability * weight / total, Real(0));
        });
    choice.probability = probability;
    return choice;
}

/// Halves an index if an element has two parts. \param odd whether the rest is 1
template <class Real>
NUSSELT_INLINE index_t<Real> parent_of(const index_t<Real>& index, int parts, mask_t<Real>& odd) noexcept {
    if constexpr (RealTraits<Real>::kLanes == 1) {
        odd = (index & (parts - 1)) != 0;
        return index >> (parts - 1);
    } else {
        const Real half = floor(index / Real(parts));
        odd = half * Real(parts) != index;
        return half;
    }
}

/// The probability of a texel given its cell, and the random numbers that lead there.
/// \param choice with the texel, and with the random numbers inside of it.
template <class Real, class PartsOf>
NUSSELT_HD inline TexelChoice<Real> ascend(const PyramidShape& shape, TexelChoice<Real> choice,
                                           const PartsOf& parts_of) noexcept {
    choice.probability = Real(1);
    for (int level = 1; level < shape.levels; ++level) {
        mask_t<Real> i, j;
        choice.i = parent_of<Real>(choice.i, shape.columns_of(level), i);
        choice.j = parent_of<Real>(choice.j, shape.rows_of(level), j);
        const ElementParts<Real> parts = parts_of(level, choice.i, choice.j);
        const Real left = parts.column(0), right = parts.column(1);
        const Real low = parts.in_row(0, i), high = parts.in_row(1, i);
        choice.u.x = unite_of_two(left, right, i, choice.u.x);
        choice.u.y = unite_of_two(low, high, j, choice.u.y);
        const Real total = left + right;
        choice.probability =
            select(total > Real(0), choice.probability * select(j, high, low) / total, Real(0));
    }
    return choice;
}

/// The parts of element (i, j) of a grid, weighed by what they emit.
template <class Real>
NUSSELT_HD inline ElementParts<Real> emitting_parts(const TexturePyramid<scalar_t<Real>>& pyramid, int level,
                                                    const index_t<Real>& i, const index_t<Real>& j) noexcept {
    using Index = index_t<Real>;
    const PyramidShape& shape = pyramid.shape;
    const int columns = shape.columns_of(level);
    const int rows = shape.rows_of(level);
    const int count = columns * rows;
    const LanePlaces<Real> place = places<Real>(Index(count) * i, j, count * shape.width_of(level));
    const scalar_t<Real>* const first = pyramid.weight + shape.offset[level - 1];
    const scalar_t<Real>* const second = first + (count - columns);
    ElementParts<Real> parts{columns,
                             rows,
                             {place.load(first), place.load(first + columns - 1), place.load(second),
                              place.load(second + columns - 1)}};
    if (columns == 1) parts.weight[1] = parts.weight[3] = Real(0);
    if (rows == 1) parts.weight[2] = parts.weight[3] = Real(0);
    return parts;
}

/// The weight of texel (i, j), see PyramidShape::index().
template <class Real>
NUSSELT_INLINE Real texel_weight(const TexturePyramid<scalar_t<Real>>& pyramid, const index_t<Real>& i,
                                 const index_t<Real>& j) noexcept {
    const PyramidShape& shape = pyramid.shape;
    if constexpr (RealTraits<Real>::kLanes == 1) {
        return pyramid.at(0, i, j);
    } else {
        scalar_t<Real> x[LanePlaces<Real>::kLanes];
        scalar_t<Real> y[LanePlaces<Real>::kLanes];
        i.store(x);
        j.store(y);
        LanePlaces<Real> place;
        for (int k = 0; k < LanePlaces<Real>::kLanes; ++k)
            place.lane[k] = shape.index(0, static_cast<int>(x[k]), static_cast<int>(y[k]));
        return place.load(pyramid.weight);
    }
}

/// The integrand of projected solid angles over a texture, up to a factor: zero below the horizon.
/// \tparam Lanes  the number type of the plane, or a pack of points for one plane.
template <class Lanes, class Real>
NUSSELT_INLINE Lanes relative_cosine(const TexturePlane<Real>& plane, const Lanes& x,
                                     const Lanes& y) noexcept {
    const auto at = [&](const Real& corner, const Real& side_x, const Real& side_y) {
        return multiply_add(x, Lanes(side_x), multiply_add(y, Lanes(side_y), Lanes(corner)));
    };
    const Vec3<Lanes> p{at(plane.corner.x, plane.side_x.x, plane.side_y.x),
                        at(plane.corner.y, plane.side_x.y, plane.side_y.y),
                        at(plane.corner.z, plane.side_x.z, plane.side_y.z)};
    const Lanes squared = max(dot(p, p), Lanes(kTiny<scalar_t<Real>>));
    return (max(p.z, Lanes(0)) / squared) / squared;
}

} // namespace detail

/// Texels in proportion to what they emit. Probabilities are ratios of the finest to the coarsest grid: the density is known
/// without a walk through the grids in between.
struct DescentByRadiance {
    template <class Real>
    NUSSELT_HD static TexelChoice<Real> choose(const TexturePyramid<scalar_t<Real>>& pyramid,
                                               const TexturePlane<Real>&, const detail::index_t<Real>& column,
                                               const detail::index_t<Real>& row,
                                               const Vec2<Real>& u) noexcept {
        using Index = detail::index_t<Real>;
        const Real cell = cell_weight<Real>(pyramid, column, row);
        Real texel = cell;
        TexelChoice<Real> choice = detail::descend(
            pyramid.shape, column, row, u,
            [&](int level, const Index& i, const Index& j) {
                return detail::emitting_parts<Real>(pyramid, level, i, j);
            },
            [&](const Real& weight, const Real&) { texel = weight; });
        choice.probability = probability_in(pyramid.shape, cell, texel);
        return choice;
    }
    template <class Real>
    NUSSELT_HD static Real probability(const TexturePyramid<scalar_t<Real>>& pyramid,
                                       const TexturePlane<Real>&, const detail::index_t<Real>& i,
                                       const detail::index_t<Real>& j) noexcept {
        const PyramidShape& shape = pyramid.shape;
        const Real cell = cell_weight<Real>(pyramid, cell_of<Real>(i, shape.width_log2 - shape.cells_log2),
                                            cell_of<Real>(j, shape.height_log2 - shape.cells_log2));
        return probability_in(shape, cell, detail::texel_weight<Real>(pyramid, i, j));
    }
    /// \param choice with the texel, and with the random numbers inside of it.
    template <class Real>
    NUSSELT_HD static Vec2<Real> invert(const TexturePyramid<scalar_t<Real>>& pyramid,
                                        const TexturePlane<Real>&, const TexelChoice<Real>& choice) noexcept {
        using Index = detail::index_t<Real>;
        return detail::ascend(pyramid.shape, choice,
                              [&](int level, const Index& i, const Index& j) {
                                  return detail::emitting_parts<Real>(pyramid, level, i, j);
                              })
            .u;
    }

private:
    /// \param texels_log2 texels per cell.
    template <class Real>
    NUSSELT_INLINE static detail::index_t<Real> cell_of(const detail::index_t<Real>& texel,
                                                        int texels_log2) noexcept {
        if constexpr (RealTraits<Real>::kLanes == 1)
            return texel >> texels_log2;
        else
            return floor(texel * Real(scalar_t<Real>(1) / static_cast<scalar_t<Real>>(1 << texels_log2)));
    }

    template <class Real>
    NUSSELT_INLINE static Real cell_weight(const TexturePyramid<scalar_t<Real>>& pyramid,
                                           const detail::index_t<Real>& column,
                                           const detail::index_t<Real>& row) noexcept {
        const PyramidShape& shape = pyramid.shape;
        return detail::places<Real>(column, row, 1 << shape.cells_log2)
            .load(pyramid.weight + shape.offset[shape.levels - 1]);
    }

    /// The probability of a texel in a cell, from their mean weights.
    template <class Real>
    NUSSELT_INLINE static Real probability_in(const PyramidShape& shape, const Real& cell,
                                              const Real& texel) noexcept {
        using T = scalar_t<Real>;
        const int texels_log2 =
            (shape.width_log2 - shape.cells_log2) + (shape.height_log2 - shape.cells_log2);
        return select(cell > Real(0), texel / (cell * Real(static_cast<T>(1 << texels_log2))), Real(0));
    }
};

/// Texels in proportion to what they emit times the cosine over the squared distance, at each grid by the rule for the mean
/// of a quadratic function from the centre (2/3) and the corners (1/12 each). An element keeps a weight as long as one of
/// its corners is above the horizon.
struct DescentByProduct {
    template <class Real>
    NUSSELT_HD static TexelChoice<Real>
    choose(const TexturePyramid<scalar_t<Real>>& pyramid, const TexturePlane<Real>& plane,
           const detail::index_t<Real>& column, const detail::index_t<Real>& row,
           const Vec2<Real>& u) noexcept {
        using Index = detail::index_t<Real>;
        return detail::descend(pyramid.shape, column, row, u, [&](int level, const Index& i, const Index& j) {
            return lit_parts(pyramid, plane, level, i, j);
        });
    }
    template <class Real>
    NUSSELT_HD static Real probability(const TexturePyramid<scalar_t<Real>>& pyramid,
                                       const TexturePlane<Real>& plane, const detail::index_t<Real>& i,
                                       const detail::index_t<Real>& j) noexcept {
        return walk(pyramid, plane, TexelChoice<Real>{i, j, Real(1), {Real(0), Real(0)}}).probability;
    }
    /// \copydoc DescentByRadiance::invert
    template <class Real>
    NUSSELT_HD static Vec2<Real> invert(const TexturePyramid<scalar_t<Real>>& pyramid,
                                        const TexturePlane<Real>& plane,
                                        const TexelChoice<Real>& choice) noexcept {
        return walk(pyramid, plane, choice).u;
    }

private:
    template <class Real>
    NUSSELT_HD static TexelChoice<Real> walk(const TexturePyramid<scalar_t<Real>>& pyramid,
                                             const TexturePlane<Real>& plane,
                                             const TexelChoice<Real>& choice) noexcept {
        using Index = detail::index_t<Real>;
        return detail::ascend(pyramid.shape, choice, [&](int level, const Index& i, const Index& j) {
            return lit_parts(pyramid, plane, level, i, j);
        });
    }

    template <class Real>
    NUSSELT_HD static detail::ElementParts<Real>
    lit_parts(const TexturePyramid<scalar_t<Real>>& pyramid, const TexturePlane<Real>& plane, int level,
              const detail::index_t<Real>& i, const detail::index_t<Real>& j) noexcept {
        using Lanes = detail::CellLanes<Real>;
        using L = typename Lanes::Type;
        using T = scalar_t<Real>;
        detail::ElementParts<Real> parts = detail::emitting_parts<Real>(pyramid, level, i, j);
        const PyramidShape& shape = pyramid.shape;
        const T width = T(1) / static_cast<T>(shape.width_of(level));
        const T height = T(1) / static_cast<T>(shape.height_of(level));
        // Positions in half parts: nine corners, then four centres. Where there is one part only, the others weigh nothing.
        const T step_x = width / static_cast<T>(2 * parts.columns);
        const T step_y = height / static_cast<T>(2 * parts.rows);
        static constexpr T kX[16] = {0, 2, 4, 0, 2, 4, 0, 2, 4, 1, 3, 1, 3, 0, 0, 0};
        static constexpr T kY[16] = {0, 0, 0, 2, 2, 2, 4, 4, 4, 1, 1, 3, 3, 0, 0, 0};
        const L low_x(detail::number_of<Real>(i) * Real(width));
        const L low_y(detail::number_of<Real>(j) * Real(height));
        L lanes[16 / Lanes::kCount]{};
        for (int k = 0; k < 13; k += Lanes::kCount)
            lanes[k / Lanes::kCount] =
                detail::relative_cosine(plane, multiply_add(Lanes::load_shared(kX + k), L(step_x), low_x),
                                        multiply_add(Lanes::load_shared(kY + k), L(step_y), low_y));
        Real cosine[16];
        detail::spread_cells<Real>(lanes, cosine);
        for (int k = 0; k < 4; ++k) {
            const int corner = 3 * (k / 2) + k % 2;
            const Real corners =
                (cosine[corner] + cosine[corner + 1]) + (cosine[corner + 3] + cosine[corner + 4]);
            parts.weight[k] *= Real(T(2) / T(3)) * cosine[9 + k] + Real(T(1) / T(12)) * corners;
        }
        return parts;
    }
};

NUSSELT_NAMESPACE_END
