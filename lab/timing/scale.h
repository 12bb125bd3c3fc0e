#pragma once
/// How time and memory grow with the size of scenes.

#include "lab/results/results.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

enum class ScaleScene {
    terrain, ///< hills of as many triangles under one square light
    light,   ///< a bumpy sphere of as many triangles above a floor, each of which is a light
};

/// Writes a scene as scene.pbrt and mesh.ply into a folder.
/// \param triangles  about how many; what comes out is less by at most twice its square root
/// \returns the number of triangles of the mesh
/// \throws std::runtime_error if files cannot be written
std::uint64_t write_scale_scene(ScaleScene scene, std::uint64_t triangles,
                                const std::filesystem::path& folder);

struct ScaleRow {
    ScaleScene scene;
    std::uint64_t triangles;
    std::uint64_t array_bytes; ///< of the scene's arrays in memory
    double load_seconds;
    double hierarchy_seconds;
    double render_seconds;
    // Largest resident memory, less that of a scene of a few triangles.
    std::uint64_t load_bytes;   ///< while the scene is loaded
    std::uint64_t render_bytes; ///< until it is rendered
};

/// Loads and renders generated scenes of increasing size, each in a process of its own.
/// \param program  path of the program "nusselt"
/// \param largest  number of triangles of the last scene; those before have a tenth, down to a thousandth
/// \throws std::runtime_error if files cannot be written or the program fails
std::vector<ScaleRow> measure_scale(ScaleScene scene, std::uint64_t largest,
                                    const std::filesystem::path& program);

/// The exponent with which the time for all that grows with the scene has grown from the last row but one to the last;
/// nothing grows faster than linearly if it is one. Nothing if fewer than two rows, or as many triangles in both, or none
/// of what is measured in one, do not tell.
std::optional<double> time_exponent(const std::vector<ScaleRow>& rows);
/// Likewise of the memory for rendering.
std::optional<double> memory_exponent(const std::vector<ScaleRow>& rows);

/// The rows with all numbers.
ResultTable scale_table(const std::vector<ScaleRow>& rows);

} // namespace nusselt::lab
