#pragma once
/// Limits on the size of files. Few bytes can demand much memory; without limits a small archive of files would fill
/// it.

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace nusselt::scene {

/// A number of bytes or of other units that several users share, in any thread.
class Budget {
public:
    /// \param message  of the error when there is not enough
    Budget(std::uint64_t limit, std::string message) : left_(limit), message_(std::move(message)) {}

    /// Throws std::runtime_error if not that much is left; it is then used up.
    void take(std::uint64_t amount) {
        std::uint64_t left = left_.load();
        while (!left_.compare_exchange_weak(left, amount <= left ? left - amount : 0)) {
        }
        if (amount > left) throw std::runtime_error(message_);
    }

private:
    std::atomic<std::uint64_t> left_;
    std::string message_;
};

inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 34;
inline constexpr std::uint64_t kMaxJsonBytes = 256 << 20; ///< also after decompression

/// A gzip file may decompress to this many times its own size and some bytes more. Scenes and meshes take up to
/// thirty times; more are damaged, or made to fill the memory.
inline constexpr std::uint64_t kMaxInflation = 100;
inline constexpr std::uint64_t kFreelyInflated = 1 << 20;

} // namespace nusselt::scene
