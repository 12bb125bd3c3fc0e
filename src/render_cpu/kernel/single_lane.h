#pragma once
/// Access to single lanes of objects that consist of packs only, such as Vec3<Real>, Ltc<Real> or LineFamily<Real,
/// N>.

#include "render_cpu/kernel/lanes.h"

#include <type_traits>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

namespace detail {

/// The values of an object, one pack after another.
template <class T>
struct PackArray {
    static_assert(std::is_trivially_copyable<T>::value && sizeof(T) % sizeof(Real) == 0, "packs only");
    static constexpr int kCount = sizeof(T) / sizeof(Real);

    explicit PackArray(const T& object) noexcept { __builtin_memcpy(value, &object, sizeof(T)); }

    alignas(Real) float value[kCount * kLanes];
};

template <int kCount>
struct Reals {
    Real value[kCount];
};

template <int kCount>
struct Floats {
    float value[kCount];
};

} // namespace detail

/// A copy of the object in which all lanes equal one of them.
template <class T>
T broadcast_lane(const T& object, int lane) noexcept {
    const detail::PackArray<T> from(object);
    detail::Reals<from.kCount> to;
    for (int i = 0; i < from.kCount; ++i) to.value[i] = Real(from.value[i * kLanes + lane]);
    return __builtin_bit_cast(T, to);
}

/// One of two objects for each lane: a where the mask is set.
template <class T>
T select_lanes(LaneMask mask, const T& a, const T& b) noexcept {
    constexpr int kCount = detail::PackArray<T>::kCount;
    const auto from_a = __builtin_bit_cast(detail::Reals<kCount>, a);
    auto result = __builtin_bit_cast(detail::Reals<kCount>, b);
    for (int i = 0; i < kCount; ++i) result.value[i] = select(mask, from_a.value[i], result.value[i]);
    return __builtin_bit_cast(T, result);
}

/// One lane as an object of floats.
/// \tparam Single the type of the object with float in place of Real.
template <class Single, class T>
Single single_lane(const T& object, int lane) noexcept {
    const detail::PackArray<T> from(object);
    detail::Floats<from.kCount> to;
    for (int i = 0; i < from.kCount; ++i) to.value[i] = from.value[i * kLanes + lane];
    return __builtin_bit_cast(Single, to);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
