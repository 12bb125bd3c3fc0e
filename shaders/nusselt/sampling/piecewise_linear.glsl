#ifndef NUSSELT_SAMPLING_PIECEWISE_LINEAR_GLSL
#define NUSSELT_SAMPLING_PIECEWISE_LINEAR_GLSL
// Follows include/nusselt/sampling/piecewise_linear.h @ 4bf771354ecf
/// A piecewise linear density on the unit interval, and its inverse distribution. Twin of
/// include/nusselt/sampling/piecewise_linear.h, for a fixed number of nodes.

#include "../core/real.glsl"

/// The number of nodes at which the density is given. Tables of this size stay in registers.
const int kNusseltNodes = 7;

/// The position of node i, in [0, 1]: nodes are closer to each other near both ends.
float piecewise_linear_node(int i) {
    float t = float(i) * (1.0 / float(kNusseltNodes - 1));
    return t * t * (3.0 - 2.0 * t);
}

struct PiecewiseLinear {
    float value[kNusseltNodes];
    float below[kNusseltNodes]; ///< integral from 0 to the node
};

/// \param value at the nodes, not negative, not normalised.
PiecewiseLinear make_piecewise_linear(float value[kNusseltNodes]) {
    PiecewiseLinear self;
    self.value[0] = value[0];
    self.below[0] = 0.0;
    NUSSELT_UNROLL for (int i = 1; i < kNusseltNodes; ++i) {
        float width = piecewise_linear_node(i) - piecewise_linear_node(i - 1);
        self.value[i] = value[i];
        self.below[i] = self.below[i - 1] + 0.5 * width * (value[i - 1] + value[i]);
    }
    return self;
}

/// The integral over [0, 1].
float piecewise_linear_integral(PiecewiseLinear self) { return self.below[kNusseltNodes - 1]; }

struct PiecewiseLinearSegment {
    float begin, width, left, right, below;
};

PiecewiseLinearSegment piecewise_linear_segment(PiecewiseLinear self, int i) {
    float begin = piecewise_linear_node(i);
    return PiecewiseLinearSegment(begin, piecewise_linear_node(i + 1) - begin, self.value[i], self.value[i + 1],
                                  self.below[i]);
}

/// The segment that x in [0, 1] is in.
PiecewiseLinearSegment piecewise_linear_segment_at(const PiecewiseLinear self, float x) {
    PiecewiseLinearSegment s = piecewise_linear_segment(self, 0);
    NUSSELT_UNROLL for (int i = 1; i < kNusseltNodes - 1; ++i) {
        if (x >= piecewise_linear_node(i)) s = piecewise_linear_segment(self, i);
    }
    return s;
}

/// \param u in [0, 1)
/// \return x in [0, 1] with below(x) = u integral, increasing with u.
float piecewise_linear_invert(PiecewiseLinear self, float u) {
    float target = u * piecewise_linear_integral(self);
    PiecewiseLinearSegment s = piecewise_linear_segment(self, 0);
    NUSSELT_UNROLL for (int i = 1; i < kNusseltNodes - 1; ++i) {
        if (target >= self.below[i]) s = piecewise_linear_segment(self, i);
    }
    float rest = nusselt_max(target - s.below, 0.0) / s.width;
    float root = sqrt(nusselt_max(nusselt_fma(2.0 * (s.right - s.left), rest, s.left * s.left), 0.0));
    float denominator = s.left + root;
    float share = 2.0 * rest / (denominator > 0.0 ? denominator : 1.0);
    return nusselt_fma(nusselt_min(share, 1.0), s.width, s.begin);
}

/// \param x in [0, 1]
float piecewise_linear_value(const PiecewiseLinear self, float x) {
    PiecewiseLinearSegment s = piecewise_linear_segment_at(self, x);
    return nusselt_fma((x - s.begin) / s.width, s.right - s.left, s.left);
}

/// The integral from 0 to x in [0, 1].
float piecewise_linear_below(const PiecewiseLinear self, float x) {
    PiecewiseLinearSegment s = piecewise_linear_segment_at(self, x);
    float share = (x - s.begin) / s.width;
    return nusselt_fma(s.width * share, nusselt_fma(0.5 * share, s.right - s.left, s.left), s.below);
}

#endif
