#pragma once
/// What runs in parallel over the cells of a lattice: cells for one shading point, shading points for packs.

#include <nusselt/simd/pack.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// Scalars take neighbouring cells of a row at once. Packs have a shading point per lane and take one cell after the other:
/// arrays with a number per cell have kPoints numbers per cell then.
/// \tparam Real float, double, long double or a pack.
template <class Real>
struct CellLanes {
    using Scalar = scalar_t<Real>;
    static constexpr int kPoints = RealTraits<Real>::kLanes;
#if NUSSELT_HAS_VERTEX_LANES
    static constexpr bool kArePacks = kPoints == 1 && !std::is_same_v<Real, long double>;
#else
    static constexpr bool kArePacks = false;
#endif
    /// Cells that are computed together.
    static constexpr int kCount = kArePacks ? 8 : 1;
    using Type = std::conditional_t<kArePacks, Pack<std::conditional_t<kArePacks, Scalar, float>, 8>, Real>;

    /// \param source of the first lane: in an array of kPoints numbers per cell, &array[kPoints * cell].
    NUSSELT_INLINE static Type load(const Scalar* source) noexcept {
        if constexpr (std::is_same_v<Type, Scalar>)
            return *source;
        else
            return Type::load(source);
    }
    /// \copydoc load
    NUSSELT_INLINE static void store(Scalar* target, const Type& x) noexcept {
        if constexpr (std::is_same_v<Type, Scalar>)
            *target = x;
        else
            x.store(target);
    }
    /// From an array of one number per cell, the same for all shading points.
    NUSSELT_INLINE static Type load_shared(const Scalar* source) noexcept {
        if constexpr (kArePacks)
            return Type::load(source);
        else
            return Type(*source);
    }
    /// The sum over cells.
    NUSSELT_INLINE static Real sum(const Type& x) noexcept {
        if constexpr (kArePacks) {
            Scalar each[kCount];
            store(each, x);
            Scalar total = Scalar(0);
            for (const Scalar& value : each) total += value;
            return total;
        } else {
            return x;
        }
    }
    /// first, first + 1, ... per cell.
    NUSSELT_INLINE static Type count_from(int first) noexcept {
        if constexpr (kArePacks)
            return Type(static_cast<Scalar>(first)) + load(kSteps);
        else
            return Type(static_cast<Scalar>(first));
    }

private:
    static constexpr Scalar kSteps[8] = {0, 1, 2, 3, 4, 5, 6, 7};
};

/// Values of all cells one by one. \param lanes those of cells that were computed together
template <class Real, int count>
NUSSELT_INLINE void spread_cells(const typename CellLanes<Real>::Type (&lanes)[count],
                                 Real (&cells)[count * CellLanes<Real>::kCount]) noexcept {
    for (int k = 0; k < count; ++k) {
        if constexpr (CellLanes<Real>::kArePacks)
            lanes[k].store(cells + k * CellLanes<Real>::kCount);
        else
            cells[k] = lanes[k];
    }
}

} // namespace detail

NUSSELT_NAMESPACE_END
