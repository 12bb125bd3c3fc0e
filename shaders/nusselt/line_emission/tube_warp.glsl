#ifndef NUSSELT_LINE_EMISSION_TUBE_WARP_GLSL
#define NUSSELT_LINE_EMISSION_TUBE_WARP_GLSL
// Follows include/nusselt/line_emission/textured_tube.h @ 9b9a07092402
// Follows include/nusselt/sampling/piecewise_linear.h @ 4bf771354ecf
/// What TexturedTube and TexturedTubeLtc share: a piecewise linear density of the second random number, in proportion to the
/// radiance of the places that it leads to. Twin of a part of include/nusselt/line_emission/textured_tube.h.

#include "../line_emission/line_profile.glsl"
#include "../sampling/cylinder_fan.glsl"

const int kNusseltTubeNodes = 33;
/// Of the mean radiance, at all nodes: the first random number leads to slightly other places than the nodes, which may be
/// brighter.
const float kNusseltLeastRadiance = 0.1;

/// A PiecewiseLinear of C++. It has too many nodes for registers, so that loops replace the selection of piecewise_linear.glsl.
struct TubeWarp {
    float value[kNusseltTubeNodes]; ///< at the nodes, not normalised
    float below[kNusseltTubeNodes]; ///< integral from 0 to the node
};

/// The position of node i, in [0, 1]: nodes are closer to each other near both ends.
float tube_warp_node(int i) {
    float t = float(i) * (1.0 / float(kNusseltTubeNodes - 1));
    return t * t * (3.0 - 2.0 * t);
}

/// Mean radiance between two places, over that of the profile. \param mean of the profile
float tube_relative_radiance(uint profile, float mean, float from, float to) {
    float least = nusselt_min(from, to);
    float len = nusselt_max(from, to) - least;
    float around;
    // A few texels are not lost to rounding.
    if (len > 1e-4)
        around = (line_profile_below(profile, least + len) - line_profile_below(profile, least)) / len;
    else
        around = mean_of_channels(line_profile_lookup(profile, least));
    return mean > 0.0 ? nusselt_max(around, kNusseltLeastRadiance * mean) / mean : 0.0;
}

/// \param fan           of the technique, in coordinates of order one.
/// \param inverse_scale of these coordinates.
/// \param axis          in shading space [m].
TubeWarp tube_warp_prepare(const CylinderFan fan, float inverse_scale, const LineSegment axis, uint profile) {
    TubeWarp self;
    float mean = line_profile_below(profile, 1.0);
    CylinderHalfPlane half_plane = cylinder_fan_half_plane(fan, 0.5);
    float before = place_along(axis, inverse_scale * cylinder_fan_point_in(fan, half_plane, 0.0));
    float here = before;
    for (int i = 0; i < kNusseltTubeNodes; ++i) {
        // At both ends, the neighbour that is missing is the node itself.
        float next = here;
        if (i + 1 < kNusseltTubeNodes) {
            float y = below_one(tube_warp_node(i + 1));
            next = place_along(axis, inverse_scale * cylinder_fan_point_in(fan, half_plane, y));
        }
        self.value[i] = tube_relative_radiance(profile, mean, 0.5 * (before + here), 0.5 * (here + next));
        self.below[i] = 0.0;
        if (i > 0)
            self.below[i] = self.below[i - 1] + 0.5 * (tube_warp_node(i) - tube_warp_node(i - 1)) *
                                                    (self.value[i - 1] + self.value[i]);
        before = here;
        here = next;
    }
    return self;
}

/// The integral over [0, 1].
float tube_warp_integral(TubeWarp self) { return self.below[kNusseltTubeNodes - 1]; }

/// The segment that x in [0, 1] is in.
int tube_warp_segment_at(float x) {
    int i = 0;
    while (i < kNusseltTubeNodes - 2 && x >= tube_warp_node(i + 1)) ++i;
    return i;
}

/// \param u in [0, 1)
/// \return x in [0, 1] with tube_warp_below(x) = u integral, increasing with u.
float tube_warp_invert(TubeWarp self, float u) {
    float target = u * tube_warp_integral(self);
    int i = 0;
    while (i < kNusseltTubeNodes - 2 && target >= self.below[i + 1]) ++i;
    float width = tube_warp_node(i + 1) - tube_warp_node(i);
    float left = self.value[i];
    float rest = nusselt_max(target - self.below[i], 0.0) / width;
    float root = sqrt(nusselt_max(nusselt_fma(2.0 * (self.value[i + 1] - left), rest, left * left), 0.0));
    float denominator = left + root;
    float share = 2.0 * rest / (denominator > 0.0 ? denominator : 1.0);
    return nusselt_fma(nusselt_min(share, 1.0), width, tube_warp_node(i));
}

/// The density at x in [0, 1]; 0 for a black profile.
float tube_warp_density(TubeWarp self, float x) {
    int i = tube_warp_segment_at(x);
    float share = (x - tube_warp_node(i)) / (tube_warp_node(i + 1) - tube_warp_node(i));
    float whole = tube_warp_integral(self);
    return whole > 0.0 ? nusselt_fma(share, self.value[i + 1] - self.value[i], self.value[i]) / whole : 0.0;
}

/// The density of a sample whose second random number x has this density. \param pdf of the technique
float tube_warp_density_of_sample(const TubeWarp self, float pdf, float x) {
    float density = pdf * tube_warp_density(self, x);
    return is_finite(density) ? density : 0.0;
}

/// The integral from 0 to x in [0, 1].
float tube_warp_below(TubeWarp self, float x) {
    int i = tube_warp_segment_at(x);
    float width = tube_warp_node(i + 1) - tube_warp_node(i);
    float share = (x - tube_warp_node(i)) / width;
    float rise = self.value[i + 1] - self.value[i];
    return nusselt_fma(width * share, nusselt_fma(0.5 * share, rise, self.value[i]), self.below[i]);
}

#endif
