#pragma once
/// How much the files of a scene may hold together.

#include "scene/input/limits.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace nusselt::scene {

// All files of a scene together.
inline constexpr std::uint64_t kMaxInflatedBytes = std::uint64_t{1} << 32;
inline constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 31;
inline constexpr std::uint64_t kMaxRepeatedMeshBytes = std::uint64_t{1}
                                                       << 32; ///< of files that are read again

// Copies of lights. They are not instanced, so a short text may ask for very many of them.
inline constexpr std::size_t kMaxLightCopies = std::size_t{1} << 17;
inline constexpr std::size_t kMaxCopiedValues = std::size_t{1} << 26; ///< numbers that describe their shapes

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
