#pragma once
/// Indices that differ between the lanes of a pack.

#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// An int for scalars, a pack of whole numbers for packs.
template <class Real>
using index_t = std::conditional_t<RealTraits<Real>::kLanes == 1, int, Real>;

/// The largest whole number up to x, within [0, size). \param x may be NaN in packs.
template <class Real>
NUSSELT_INLINE index_t<Real> index_below(const Real& x, int size) noexcept {
    if constexpr (RealTraits<Real>::kLanes == 1) {
        const int i = static_cast<int>(x);
        return i < 0 ? 0 : i < size ? i : size - 1;
    } else {
        return min(max(floor(x), Real(0)), Real(size - 1));
    }
}

/// The index as a number.
template <class Real>
NUSSELT_INLINE Real number_of(const index_t<Real>& index) noexcept {
    return static_cast<Real>(index);
}

/// a where the mask is set, else b. Masks of random numbers are random: for scalars, this does not branch.
template <class Real>
NUSSELT_INLINE index_t<Real> select_index(const mask_t<Real>& mask, const index_t<Real>& a,
                                          const index_t<Real>& b) noexcept {
    if constexpr (RealTraits<Real>::kLanes == 1)
        return b ^ ((a ^ b) & -static_cast<int>(mask));
    else
        return select(mask, a, b);
}

/// Calls f(lane) for the lanes of a mask.
template <class Mask, class Function>
NUSSELT_INLINE void for_each_lane(const Mask& mask, const Function& f) noexcept {
    if constexpr (std::is_same_v<Mask, bool>) {
        if (mask) f(0);
    } else {
        for (std::uint32_t bits = mask.bits(), lane = 0; bits != 0; bits >>= 1, ++lane)
            if ((bits & 1u) != 0) f(static_cast<int>(lane));
    }
}
/// All lanes, from an array with a number for each.
template <class Real>
NUSSELT_INLINE Real load_lanes(const scalar_t<Real>* source) noexcept {
    if constexpr (RealTraits<Real>::kLanes == 1)
        return *source;
    else
        return Real::load(source);
}
/// All lanes, into an array with a number for each.
template <class Real>
NUSSELT_INLINE void store_lanes(scalar_t<Real>* target, const Real& x) noexcept {
    if constexpr (RealTraits<Real>::kLanes == 1)
        *target = x;
    else
        x.store(target);
}

/// One lane of a vector.
template <class Real>
NUSSELT_INLINE Vec2<scalar_t<Real>> lane_of(const Vec2<Real>& v, int lane) noexcept {
    if constexpr (RealTraits<Real>::kLanes == 1)
        return v;
    else
        return {v.x.lane(lane), v.y.lane(lane)};
}
template <class Real>
NUSSELT_INLINE void set_lane(Vec2<Real>& v, int lane, const Vec2<scalar_t<Real>>& value) noexcept {
    if constexpr (RealTraits<Real>::kLanes == 1) {
        v = value;
    } else {
        v.x.set_lane(lane, value.x);
        v.y.set_lane(lane, value.y);
    }
}

/// The places in an array where the lanes look something up.
template <class Real>
struct LanePlaces {
    static constexpr int kLanes = RealTraits<Real>::kLanes;
    std::int32_t lane[kLanes];

    /// From an array that all lanes share.
    NUSSELT_INLINE Real load(const scalar_t<Real>* base) const noexcept {
        if constexpr (kLanes == 1)
            return base[lane[0]];
        else
            return Real::gather(base, lane);
    }
    /// From an array of kLanes numbers per element, one for each lane.
    NUSSELT_INLINE Real load_own(const scalar_t<Real>* base) const noexcept {
        LanePlaces own;
        for (int k = 0; k < kLanes; ++k) own.lane[k] = kLanes * lane[k] + k;
        return own.load(base);
    }
};

/// The places of elements row * width + column.
template <class Real>
NUSSELT_INLINE LanePlaces<Real> places(const index_t<Real>& column, const index_t<Real>& row,
                                       int width) noexcept {
    LanePlaces<Real> result;
    if constexpr (LanePlaces<Real>::kLanes == 1) {
        result.lane[0] = row * width + column;
    } else {
        scalar_t<Real> x[LanePlaces<Real>::kLanes];
        scalar_t<Real> y[LanePlaces<Real>::kLanes];
        column.store(x);
        row.store(y);
        for (int k = 0; k < LanePlaces<Real>::kLanes; ++k)
            result.lane[k] = static_cast<std::int32_t>(y[k]) * width + static_cast<std::int32_t>(x[k]);
    }
    return result;
}

} // namespace detail

NUSSELT_NAMESPACE_END
