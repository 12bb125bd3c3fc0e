#pragma once
/// Cells of a lattice as lanes of a register.

#include <nusselt/simd/pack.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

/// Neighbouring cells of a row that are computed together.
template <class T>
struct CellLanes {
#if NUSSELT_HAS_VERTEX_LANES
    static constexpr bool kArePacks = !std::is_same_v<T, long double>;
#else
    static constexpr bool kArePacks = false;
#endif
    static constexpr int kCount = kArePacks ? 8 : 1;
    using Type = std::conditional_t<kArePacks, Pack<std::conditional_t<kArePacks, T, float>, 8>, T>;

    NUSSELT_INLINE static Type load(const T* source) noexcept {
        if constexpr (kArePacks)
            return Type::load(source);
        else
            return *source;
    }
    NUSSELT_INLINE static void store(T* target, const Type& x) noexcept {
        if constexpr (kArePacks)
            x.store(target);
        else
            *target = x;
    }
    NUSSELT_INLINE static T sum(const Type& x) noexcept {
        T each[kCount];
        store(each, x);
        T total = T(0);
        for (const T& value : each) total += value;
        return total;
    }
    /// first, first + 1, ...
    NUSSELT_INLINE static Type count_from(int first) noexcept {
        return Type(static_cast<T>(first)) + load(kSteps);
    }

private:
    static constexpr T kSteps[8] = {0, 1, 2, 3, 4, 5, 6, 7};
};

} // namespace detail

NUSSELT_NAMESPACE_END
