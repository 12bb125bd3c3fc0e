#pragma once
/// A hash that recognises data. It is not cryptographic: collisions can be constructed.

#include "scene/model/float3.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace nusselt::scene {

/// Types whose bytes are all part of their value, so that arrays of them can be hashed at once.
template <class T>
inline constexpr bool kIsPlain =
    std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Float2> || std::is_same_v<T, Float3>;

/// Takes about a nanosecond for 4 bytes. The hash depends on the order and the sizes of the values.
class ContentHash {
public:
    void add_bytes(const void* data, std::size_t size) {
        const char* bytes = static_cast<const char*>(data);
        std::size_t left = size;
        for (; left >= sizeof(std::uint64_t); left -= sizeof(std::uint64_t), bytes += sizeof(std::uint64_t)) {
            std::uint64_t word;
            std::memcpy(&word, bytes, sizeof word);
            mix(word);
        }
        std::uint64_t rest = 0;
        if (left > 0) std::memcpy(&rest, bytes, left);
        mix(rest);
        mix(size);
    }

    /// Adds values whose bytes are all part of them.
    template <class... Values>
    void add(const Values&... values) {
        static_assert((kIsPlain<Values> && ...));
        (add_bytes(&values, sizeof values), ...);
    }

    std::uint64_t value() const {
        std::uint64_t h = state_;
        h = (h ^ (h >> 32)) * kMultiplier;
        h = (h ^ (h >> 29)) * kMultiplier;
        return h ^ (h >> 32);
    }

private:
    static constexpr std::uint64_t kMultiplier = 0x9e3779b97f4a7c15u; ///< odd: 2^64 over the golden ratio

    void mix(std::uint64_t word) { state_ = std::rotl((state_ ^ word) * kMultiplier, 29); }

    std::uint64_t state_ = kMultiplier;
};

} // namespace nusselt::scene
