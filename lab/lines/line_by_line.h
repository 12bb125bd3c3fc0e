#pragma once
/// The baseline for the visibility of lines: each traverses a hierarchy by itself, as in N. Billen and P. Dutre 2016, Line
/// Sampling for Direct Illumination, Sec. 5.2.

#include "lab/lines/line_by_line_kernel.h"
#include "render_cpu/renderer.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::lab {

/// Work for lines that were traced one by one.
struct LineByLineWork {
    LineCounts counts;
    double seconds = 0; ///< of all threads together

    double seconds_per_line() const;

    LineByLineWork& operator+=(const LineByLineWork& other);
};

/// Where lines start.
struct LinePoint {
    std::size_t pixel; ///< y * width + x
    float apex[3];     ///< where shadow rays start [m]
    float normal[3];   ///< geometric, unit, on the side of the eye
};

/// With these, the renderer takes lines of the same density as trace_line_by_line(), all of a point together.
/// \param lines per point and light
render::RenderSettings settings_of_lines_together(int lines);

/// What the centres of every `step`-th pixel of every `step`-th row see; pixels that see no surface, or a light, are left
/// out.
std::vector<LinePoint> line_points(const scene::Scene& scene, const render_cpu::Renderer& renderer, int step);

/// Traces stratified, parallel lines, by length, of all polygonal lights for all points. The hierarchy is binary with up to
/// four triangles per leaf, as that of pbrt, which the authors used. The code is scalar, for the best instruction set of the
/// processor. Surfaces that are partly there are left out: the renderer takes points for lights that they may hide.
/// \param lines per point and light
/// \returns the work of each point
/// \throws std::runtime_error for scenes with instances or with lights of more than eight vertices; if a line falls into more parts than there is room for; and if Embree fails to build a hierarchy
std::vector<LineByLineWork> trace_line_by_line(const scene::Scene& scene,
                                               const std::vector<LinePoint>& points, int lines, int threads);

} // namespace nusselt::lab
