/// Compiled once per instruction set; see line_by_line_kernel.h.

#include "lab/lines/line_by_line_kernel.h"
#include "proof/hostile/lights.h"

#include <nusselt/line_samples/line_family.h>
#include <nusselt/line_samples/visible_parts.h>
#include <nusselt/related/shadow_triangle_billen.h>

#include <algorithm>

NUSSELT_NAMESPACE_BEGIN
namespace line_by_line {

using lab::LineCounts;
using lab::LineEmitter;
using lab::LineNode;
using lab::LineOccluder;
using lab::LineView;
using lab::LineWorld;
using Vector = Vec3<float>;

inline Vector vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

constexpr int kMostParts = 2048;
constexpr int kStackSize = 128;

/// Takes what occluders hide from the parts of a line.
/// \param extent of the line
inline void trace_line(const LineWorld& world, const ShadowTriangle<float>& triangle,
                       const Interval<float>& extent, VisibleParts<float>& parts, LineCounts& counts) {
    if (world.nodes == nullptr) return;
    std::uint32_t stack[kStackSize];
    int size = 0;
    stack[size++] = 0;
    const float length = extent.end - extent.begin;
    while (size > 0) {
        const LineNode& node = world.nodes[stack[--size]];
        if (node.is_leaf) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                ++counts.triangle_tests;
                const auto& corner = world.occluders[i].corner;
                const Interval<float> hidden =
                    triangle.hidden_by({vector(corner[0]), vector(corner[1]), vector(corner[2])});
                if (hidden.begin < hidden.end)
                    parts.cut({extent.begin + hidden.begin * length, extent.begin + hidden.end * length});
            }
            continue;
        }
        for (std::uint32_t k = 0; k < node.count; ++k) {
            ++counts.box_tests;
            if (triangle.overlaps(vector(node.centre[k]), vector(node.half[k])))
                stack[size++] = node.child[k];
        }
    }
}

inline void trace_emitter(const LineWorld& world, const LineEmitter& emitter, const LineView& view,
                          hostile::RandomSource& random, LineCounts& counts) {
    constexpr int kVertices = LineEmitter::kMostVertices;
    const Vector apex = vector(view.apex);
    const Vector normal = vector(view.normal);
    Vector vertices[kVertices] = {};
    float highest = 0;
    for (int i = 0; i < emitter.vertex_count; ++i) {
        vertices[i] = vector(emitter.vertex[i]);
        highest = std::max(highest, dot(normal, vertices[i] - apex));
    }
    const auto polygon = make_polygon<kVertices>(vertices, emitter.vertex_count);
    const bool is_behind = !emitter.two_sided && dot(polygon.normal, vertices[0] - apex) >= 0;
    if (is_behind || highest <= 0) return;
    const LineFamily<float, kVertices> family(polygon, kPi<float> * static_cast<float>(random.uniform()));
    const LinePlane<float>& plane = family.plane();
    Interval<float> memory[kMostParts];
    VisibleParts<float> parts(memory, kMostParts);
    counts.lines += static_cast<std::uint64_t>(view.lines);
    for (int k = 0; k < view.lines; ++k) {
        const auto u = static_cast<float>((k + random.uniform()) / view.lines);
        const LineChoice<float> choice = family.sample_by_length(std::min(u, 1 - 1e-7f));
        const Interval<float> chord = family.chord(choice.offset).extent;
        const auto at = [&](float t) {
            return fma(t, plane.along, fma(choice.offset, plane.across, plane.origin));
        };
        const Interval<float> extent =
            part_above_horizon(at(chord.begin) - apex, at(chord.end) - apex, normal, chord);
        parts.reset(extent);
        if (!(extent.begin < extent.end)) continue;
        const ShadowTriangle<float> triangle(apex, at(extent.begin), at(extent.end));
        trace_line(world, triangle, extent, parts, counts);
        for (int i = 0; i < parts.count(); ++i) counts.parts += parts[i].begin < parts[i].end ? 1 : 0;
        counts.lost_parts += static_cast<std::uint64_t>(parts.lost());
    }
}

inline LineCounts trace_lines(const LineWorld& world, const LineView& view) {
    LineCounts counts;
    hostile::RandomSource random(1, view.stream);
    for (int i = 0; i < world.emitter_count; ++i)
        trace_emitter(world, world.emitters[i], view, random, counts);
    return counts;
}

} // namespace line_by_line
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

template <>
TraceLines trace_lines_function<base::Isa::NUSSELT_UNIT_ISA>() {
    return line_by_line::trace_lines;
}

} // namespace nusselt::lab
