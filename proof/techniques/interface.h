#pragma once
/// The interface of a technique, checked at compile time.

#include <type_traits>

#include <nusselt/core/light_sample.h>

#include "proof/techniques/light_kinds.h"

NUSSELT_NAMESPACE_BEGIN
namespace hostile {

/// Fails to compile unless a technique has the interface that docs/conventions.md describes, in a number type.
/// \tparam Kind of the registry.
template <class Kind, class Real>
constexpr bool is_technique() {
    using Technique = typename Kind::template Technique<Real>;
    using Light = typename Kind::template Light<Real>;
    using Random = typename Kind::template Random<Real>;
    using Wi = const Vec3<Real>&;
    constexpr const Technique* self = nullptr;
    static_assert(std::is_nothrow_constructible_v<Technique, const Light&>,
                  "prepares a light and throws nothing");
    static_assert(!std::is_convertible_v<const Light&, Technique>, "its constructor is explicit");
    static_assert(std::is_trivially_copyable_v<Technique>,
                  "is plain data, so that GPUs and packs can copy it");
    static_assert(std::is_same_v<decltype(self->sample(Random())), LightSample<Real>>, "sample(u)");
    static_assert(std::is_same_v<decltype(self->pdf(Wi(Vec3<Real>()))), Real>, "pdf(wi)");
    static_assert(std::is_same_v<decltype(self->invert(Wi(Vec3<Real>()))), Random>, "invert(wi)");
    static_assert(std::is_same_v<decltype(self->measure()), Real>, "measure()");
    static_assert(noexcept(self->sample(Random()))&& noexcept(self->pdf(Vec3<Real>()))&& noexcept(
                      self->invert(Vec3<Real>()))&& noexcept(self->measure()),
                  "its functions throw nothing");
    if constexpr (RealTraits<Real>::kLanes > 1) {
        using Single = typename Kind::template Technique<scalar_t<Real>>;
        static_assert(std::is_constructible_v<Technique, const Single&>,
                      "broadcasts the technique for one light");
    }
    return true;
}

} // namespace hostile
NUSSELT_NAMESPACE_END
