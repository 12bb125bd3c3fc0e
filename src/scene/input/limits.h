#pragma once
/// How much the files of a scene may hold, one by one and together. Few bytes can ask for much memory; without limits a
/// small archive of files would fill it.

#include <atomic>
#include <cstddef>
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

// Single files.
inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 34;
inline constexpr std::uint64_t kMaxJsonBytes = 256 << 20;              ///< also after decompression
inline constexpr std::int64_t kMaxImageTexels = std::int64_t{1} << 28; ///< 3 GiB of floats

inline constexpr int kMaxFilmSize = 65536; ///< pixels along an axis

/// What a gzip file may decompress to: this many times its own size and some bytes more. Scenes and meshes take up to
/// thirty times; more are damaged, or made to fill the memory.
inline constexpr std::uint64_t kMaxInflation = 100;
inline constexpr std::uint64_t kFreelyInflated = 1 << 20;

// All files of a scene together.
inline constexpr std::uint64_t kMaxInflatedBytes = std::uint64_t{1} << 32;
inline constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 31;

// Files that are read again. Those that include others twice multiply quickly.
inline constexpr int kMaxRepeatedIncludes = 1000;
inline constexpr std::size_t kMaxRepeatedBytes = std::size_t{1} << 25; ///< of included texts
inline constexpr std::uint64_t kMaxRepeatedMeshBytes = std::uint64_t{1} << 32;

// Copies of lights. They are not instanced, so a short text may ask for very many of them.
inline constexpr std::size_t kMaxLightCopies = std::size_t{1} << 17;
inline constexpr std::size_t kMaxCopiedValues = std::size_t{1} << 26; ///< numbers that describe their shapes

// What indices of 32 bits tell apart beside a few special ones, those of triangles with a sign.
inline constexpr std::size_t kMaxVertices = 0xfffffffe;
inline constexpr std::size_t kMaxTriangles = 0x7fffffff;

/// What the files of one scene share.
struct SceneBudget {
    /// What gzip files decompress to.
    Budget inflated_bytes{kMaxInflatedBytes, "compressed files decompress to more than " +
                                                 std::to_string(kMaxInflatedBytes) +
                                                 " bytes in all; decompress them (gunzip)"};
    /// Of decoded images and the textures made of them.
    Budget texels{kMaxTexels, "the textures of the scene have more than " + std::to_string(kMaxTexels) +
                                  " texels in all; make them smaller"};
};

} // namespace nusselt::scene
