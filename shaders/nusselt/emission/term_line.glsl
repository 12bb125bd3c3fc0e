#ifndef NUSSELT_EMISSION_TERM_LINE_GLSL
#define NUSSELT_EMISSION_TERM_LINE_GLSL
// Follows include/nusselt/emission/cell_lattice.h @ 2af571ead029
/// Lines of lattices, which sides of cells lie on. Twin of TermLine in include/nusselt/emission/cell_lattice.h.

#include "../core/trig.glsl"
#include "../core/vec.glsl"

/// A line in shading space that the terms of Lambert's formula are taken along. Positions on it are distances [m].
struct TermLine {
    float cosine;    ///< between the zenith and the normal of the plane through the line and the origin
    float inverse;   ///< reciprocal distance of the line from the origin
    float foot;      ///< the position next to the origin
    float low, high; ///< the interval that counts, empty if equal
};

/// \param q         position 0.
/// \param direction unit.
/// \param from, to  the interval that counts before it is clipped to the horizon.
TermLine make_term_line(vec3 q, vec3 direction, float from, float to) {
    // Closer lines have a right angle or none.
    const float least = 7.888609052210118e-31; // 2^-100
    vec3 moment = nusselt_cross(q, direction);
    float inverse = 1.0 / sqrt(nusselt_max(dot(moment, moment), least));
    bool rises = direction.z > 0.0;
    bool falls = direction.z < 0.0;
    float horizon = -q.z / (rises || falls ? direction.z : 1.0);
    bool below = !(rises || falls) && q.z < 0.0;
    TermLine self;
    self.cosine = inverse * moment.z;
    self.inverse = inverse;
    self.foot = -dot(q, direction);
    self.low = rises ? nusselt_min(nusselt_max(from, horizon), to) : from;
    self.high = falls ? nusselt_max(nusselt_min(to, horizon), from) : (below ? from : to);
    return self;
}

/// A line that no horizon clips.
/// \param q, direction, low, high see make_term_line().
TermLine make_uncut_term_line(vec3 q, vec3 direction, float low, float high) {
    TermLine self = make_term_line(q, direction, low, high);
    self.low = low;
    self.high = high;
    return self;
}

/// The angle under which a part of the line is seen, times the cosine.
float term_line_term(const TermLine self, float begin, float end) {
    float a = nusselt_min(nusselt_max(begin, self.low), self.high);
    float b = nusselt_min(nusselt_max(end, self.low), self.high);
    float y = (b - a) * self.inverse;
    float x = nusselt_fma((a - self.foot) * self.inverse, (b - self.foot) * self.inverse, 1.0);
    return self.cosine * atan2_positive(y, x);
}

#endif
