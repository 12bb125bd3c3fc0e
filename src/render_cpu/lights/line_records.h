#pragma once
/// Linear lights and tubes in the form that kernels read: plain data, see kernel.h.

#include "render_cpu/kernel.h"
#include "render_cpu/lights/profile_record.h"

#include <memory>

namespace nusselt::render_cpu {

/// Cells of the table of a spread.
inline constexpr int kTubeSpreadCells = 64;

/// How the radiance of a tube or a line depends on the direction.
struct LineProfileRecord : ProfileRecord {
    /// What the spread lets pass of the light of a lateral surface, scene::TubeSpread.
    float spread[kTubeSpreadCells + 1];
};

/// A tube, with its axis in the form of LineSegment<float>.
struct LineRecord {
    scene::Float3 begin;
    scene::Float3 direction;
    float length;
    float radius;
    scene::TubeModel model;
    scene::Float3 normal; ///< of strips
    scene::Float3 radiance;
    scene::Float3 radiance_times_radius;
    scene::Float3 inverse_mean; ///< of the radiance; 0 for channels that are black everywhere
    const void* profile;        ///< a LineProfile<float, scene::kMaxLineTexels>, null for uniform radiance
    const LineProfileRecord*
        directions; ///< null for the same radiance in all directions; not together with `profile`
};

/// Makes an array of LineRecord, see LightKernel.
std::shared_ptr<const void> make_line_records(const scene::Scene& scene, const scene::LightList& list);

// In kernel/lights/line.cpp.
LightCode line_code(LaneCount<4>), line_code(LaneCount<8>), line_code(LaneCount<16>);

} // namespace nusselt::render_cpu
