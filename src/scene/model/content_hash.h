#pragma once

#include "base/content_hash.h"
#include "scene/model/float3.h"

#include <type_traits>

namespace nusselt::scene {

/// Types whose bytes are all part of their value, so that arrays of them can be hashed at once.
template <class T>
inline constexpr bool kIsPlain =
    std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Float2> || std::is_same_v<T, Float3>;

/// A hash of the data of scenes.
class ContentHash : public base::ContentHash {
public:
    /// Adds values whose bytes are all part of them.
    template <class... Values>
    void add(const Values&... values) {
        static_assert((kIsPlain<Values> && ...));
        (add_bytes(&values, sizeof values), ...);
    }
};

} // namespace nusselt::scene
