#pragma once
/// Measures how time and memory grow with the size of scenes.

#include "lab/results/results.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nusselt::lab {

enum class ScaleScene {
    terrain, ///< hills made of the triangles, under one square light
    light,   ///< a bumpy sphere above a floor, whose triangles are lights
};

/// Writes a scene as scene.pbrt and mesh.ply into a folder.
/// \param triangles approximate number; the result is less by at most twice its square root
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
    // Largest resident memory, minus that for a scene of a few triangles.
    std::uint64_t load_bytes;   ///< while the scene is loaded
    std::uint64_t render_bytes; ///< until it is rendered
};

/// Loads and renders generated scenes of increasing size, each in a separate process.
/// \param program path of the program "nusselt"
/// \param largest number of triangles of the last scene; those before it have a thousandth, a hundredth and a tenth
/// \throws std::runtime_error if files cannot be written or the program fails
std::vector<ScaleRow> measure_scale(ScaleScene scene, std::uint64_t largest,
                                    const std::filesystem::path& program);

/// The exponent with which the time for everything that depends on the size of the scene grows from the last row but
/// one to the last. An exponent of one means linear growth. Returns nothing if there are fewer than two rows, if both
/// rows have as many triangles, or if a time is zero.
std::optional<double> time_exponent(const std::vector<ScaleRow>& rows);
/// The same for the memory that rendering needs.
std::optional<double> memory_exponent(const std::vector<ScaleRow>& rows);

/// A table of the rows with all their numbers.
ResultTable scale_table(const std::vector<ScaleRow>& rows);

} // namespace nusselt::lab
