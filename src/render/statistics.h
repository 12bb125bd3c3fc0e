#pragma once
/// The work of a rendering.

#include <cstdint>

namespace nusselt::render {

/// Work for line samples.
struct LineStatistics {
    double build_seconds = 0;      ///< of their bounding volume hierarchy
    double visibility_seconds = 0; ///< for visible parts of lines, the sum over all threads
    std::uint64_t lines = 0;
    std::uint64_t parts = 0;       ///< visible ones of all lines
    std::uint64_t line_lights = 0; ///< pairs of a shading point and a light with lines
    /// Pairs that got points: there are many occluders, or partly present ones, or too few lines.
    std::uint64_t point_lights = 0;
    std::uint64_t box_tests = 0;      ///< of boxes against what lines span with their shading point
    std::uint64_t triangle_tests = 0; ///< of triangles against that
    std::uint64_t shadow_tests = 0;   ///< of shadows of triangles against a pack of lines
};

struct RenderStatistics {
    double build_seconds = 0;   ///< of the bounding volume hierarchy; on a GPU, to bring the scene there
    double compile_seconds = 0; ///< of shaders, by the driver
    double render_seconds = 0;  ///< wall clock, from the first to the last piece of work
    // Sums over all threads, or over all passes of a GPU [s].
    double primary_seconds = 0; ///< to find what camera rays hit
    double shading_seconds = 0; ///< all else but tracing; on a GPU with shadow rays
    double shadow_seconds = 0;  ///< tracing of shadow rays, which a GPU does not measure separately
    std::uint64_t primary_rays = 0;
    std::uint64_t shadow_rays = 0;
    /// Light samples that count as black because their direction, density or reflected radiance is NaN or
    /// infinite: 0 unless there is NaN or overflow in the scene, or a bug.
    std::uint64_t rejected_samples = 0;
    LineStatistics lines;
    int threads = 0; ///< of the processor that shade; 0 on a GPU
};

} // namespace nusselt::render
