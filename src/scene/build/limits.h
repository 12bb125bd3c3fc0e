#pragma once
/// Limits on all files of a scene together.

#include "scene/input/limits.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace nusselt::scene {

// All files of a scene together.
inline constexpr std::uint64_t kMaxInflatedBytes = std::uint64_t{1} << 32;
inline constexpr std::uint64_t kMaxTexels = std::uint64_t{1} << 31;
inline constexpr std::uint64_t kMaxRepeatedMeshBytes = std::uint64_t{1}
                                                       << 32; ///< in files that several shapes name

// Copies of lights. Instances copy lights, so that a short text may create very many.
inline constexpr std::size_t kMaxLightCopies = std::size_t{1} << 17;
inline constexpr std::size_t kMaxCopiedValues = std::size_t{1} << 26; ///< numbers that describe their shapes

/// Budgets that the files of one scene share.
struct SceneBudget {
    /// The decompressed bytes of gzip files.
    Budget inflated_bytes{kMaxInflatedBytes, "compressed files decompress to more than " +
                                                 std::to_string(kMaxInflatedBytes) +
                                                 " bytes in total; decompress them (gunzip)"};
    /// The texels of decoded images and of the textures made of them.
    Budget texels{kMaxTexels, "the textures of the scene have more than " + std::to_string(kMaxTexels) +
                                  " texels in total; make them smaller"};
};

} // namespace nusselt::scene
