#pragma once
/// A light, a point and occluders as plain numbers, which generators pass to code compiled for each instruction set.

namespace nusselt::proof {

/// Number of lines in a case, for every instruction set.
inline constexpr int kLinesPerCase = 16;

/// A triangle with corners in any order.
struct Occluder {
    float corner[3][3];
};

struct ShadowCase {
    float light[4][3]; ///< vertices
    float point[3];
    float angle;               ///< of the lines, see LineFamily
    float u[kLinesPerCase];    ///< of the offset of each line, in [0, 1)
    int corner[kLinesPerCase]; ///< the line passes 3 * occluder + corner; if negative, see u
    const Occluder* occluders;
    int occluder_count;
};

} // namespace nusselt::proof
