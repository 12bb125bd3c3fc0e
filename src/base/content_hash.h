#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace nusselt::base {

/// A hash that recognises data. It is not cryptographic: collisions can be constructed. It takes about a nanosecond for 4
/// bytes, and depends on the order and the sizes of what is added.
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

} // namespace nusselt::base
