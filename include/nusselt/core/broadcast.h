#pragma once
/// Copies of a light's technique in all lanes of a pack, to take many samples of one light.
///
/// Each class has one list of its members, in the order of their declaration; its broadcasting constructor is
///
///     template <class Single>
///     explicit Technique(const Technique<Single>& single) noexcept { broadcast_members<Real>(*this, single); }
///
///     friend struct detail::Members;
///     template <class Self, class Visit>
///     static void members(Self& self, const Visit& visit) noexcept { visit(self.plane_, self.corner_); }
///
/// A list that lacks a member does not compile.

#include <cstddef>
#include <type_traits>

#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

namespace detail {

constexpr std::size_t rounded_up(std::size_t size, std::size_t alignment) noexcept {
    return (size + alignment - 1) / alignment * alignment;
}

/// The size of a class with these members in this order, by the rules that all compilers share.
template <class... Member>
constexpr std::size_t size_with_members() noexcept {
    std::size_t size = 0;
    std::size_t alignment = 1;
    ((size = rounded_up(size, alignof(Member)) + sizeof(Member),
      alignment = alignof(Member) > alignment ? alignof(Member) : alignment),
     ...);
    return rounded_up(size, alignment);
}

/// A friend of the classes that have a list of members.
struct Members {
    template <class Real, class To, class From>
    NUSSELT_HD static void broadcast_all(To& to, const From& from) noexcept {
        To::members(to, [&](auto&... target) {
            static_assert(size_with_members<std::remove_reference_t<decltype(target)>...>() == sizeof(To),
                          "members() lacks a member, or does not keep the order of declaration");
            From::members(from, [&](const auto&... source) { (broadcast_one<Real>(target, source), ...); });
        });
    }

private:
    template <class Real, class To, class From>
    NUSSELT_INLINE static void broadcast_one(To& to, const From& from) noexcept {
        if constexpr (std::is_array_v<To>) {
            NUSSELT_UNROLL
            for (std::size_t i = 0; i < std::extent_v<To>; ++i) broadcast_one<Real>(to[i], from[i]);
        } else if constexpr (std::is_constructible_v<To, const From&>) {
            to = To(from);
        } else {
            to = broadcast<Real>(from);
        }
    }
};

} // namespace detail

/// Makes every member of `to` that of `from` in all lanes.
/// \tparam Real the number type of `to`.
template <class Real, class To, class From>
NUSSELT_HD inline void broadcast_members(To& to, const From& from) noexcept {
    detail::Members::broadcast_all<Real>(to, from);
}

NUSSELT_NAMESPACE_END
