#pragma once
/// The interface of the units compiled per instruction set to line_by_line.cpp: plain data and a function.

#include "base/isa.h"

#include <cstdint>

namespace nusselt::lab {

/// A node of a binary hierarchy.
struct LineNode {
    bool is_leaf;
    std::uint32_t count; ///< of children or triangles
    std::uint32_t first; ///< triangle of a leaf
    std::uint32_t child[2];
    float centre[2][3], half[2][3]; ///< of the boxes of children
};

struct LineOccluder {
    float corner[3][3];
};

/// A convex polygon.
struct LineEmitter {
    static constexpr int kMostVertices = 8;
    int vertex_count;
    float vertex[kMostVertices][3];
    bool two_sided;
};

/// What hides lines, and what they are on.
struct LineWorld {
    const LineNode* nodes; ///< the first one is the root; null without occluders
    const LineOccluder* occluders;
    const LineEmitter* emitters;
    int emitter_count;
};

/// A point from which lines are seen.
struct LineView {
    float apex[3];        ///< where shadow rays start [m]
    float normal[3];      ///< geometric, unit
    std::uint64_t stream; ///< of random numbers
    int lines;            ///< of each emitter
};

struct LineCounts {
    std::uint64_t lines = 0;
    std::uint64_t parts = 0;          ///< visible ones
    std::uint64_t box_tests = 0;      ///< of boxes of the hierarchy
    std::uint64_t triangle_tests = 0; ///< of triangles in its leaves
    std::uint64_t lost_parts = 0;     ///< for which there was no room
};

using TraceLines = LineCounts (*)(const LineWorld& world, const LineView& view);

template <base::Isa>
TraceLines trace_lines_function();

} // namespace nusselt::lab
