#ifndef NUSSELT_CONES_RIM_DISTRIBUTION_GLSL
#define NUSSELT_CONES_RIM_DISTRIBUTION_GLSL
// Follows include/nusselt/cones/rim_distribution.h @ 121f96baf6a6
// Follows include/nusselt/cones/rim_polynomial.h @ 3a20906c39f9
/// A distribution on [-1, 1] whose density is nearly (1 - z^2) times a smooth function, known at 16 places. Twin of
/// include/nusselt/cones/rim_distribution.h with 16 places; rim_polynomial.h describes the polynomials.

#include "../core/real.glsl"

const int kNusseltRimNodes = 16;

/// Nodes in increasing order, and the end of the interval.
const float kNusseltRimNode[17] =
    float[17](-0.97610555741, -0.92064918535, -0.83559353522, -0.72367932928, -0.58850483432, -0.43441503691,
              -0.26636265288, -0.08974909348, 0.08974909348, 0.26636265288, 0.43441503691, 0.58850483432,
              0.72367932928, 0.83559353522, 0.92064918535, 0.97610555741, 1.0);

/// Two rows for each coefficient: its entries for sums (even ones) or differences of the values at opposite nodes.
const vec4 kNusseltGegenbauer[32] = vec4[32](
    vec4(1.34261898e-01, 1.29946582e-01, 1.21454638e-01, 1.09058971e-01),
    vec4(9.31578998e-02, 7.42622038e-02, 5.29778752e-02, 2.99779716e-02),
    vec4(2.00831393e-02, 5.76881939e-02, 8.79362017e-02, 1.06969553e-01),
    vec4(1.12360744e-01, 1.03421696e-01, 8.12900627e-02, 4.87694411e-02),
    vec4(-7.51651640e-02, -4.89117073e-02, -3.99712426e-03, 4.65484401e-02),
    vec4(8.79559007e-02, 1.07912757e-01, 1.00065592e-01, 6.58200643e-02),
    vec4(-2.66026699e-02, -6.49863534e-02, -6.64396048e-02, -2.77089104e-02),
    vec4(3.36736252e-02, 8.78445424e-02, 1.07296705e-01, 8.05311974e-02),
    vec4(5.46811397e-02, 6.69574173e-03, -4.97737352e-02, -6.64696253e-02),
    vec4(-2.44318791e-02, 4.97823470e-02, 1.02478513e-01, 9.23969756e-02),
    vec4(3.10718415e-02, 5.69517358e-02, 1.46830436e-02, -4.97763026e-02),
    vec4(-6.06299600e-02, 4.74646432e-03, 8.66530500e-02, 1.01024036e-01),
    vec4(-4.13744886e-02, 2.27368059e-02, 5.43805500e-02, 1.72475868e-03),
    vec4(-6.14460922e-02, -3.49916712e-02, 6.22423459e-02, 1.06146559e-01),
    vec4(-3.41023263e-02, -3.82106744e-02, 3.18219965e-02, 4.53120020e-02),
    vec4(-3.11368380e-02, -5.93668146e-02, 3.26960049e-02, 1.07636006e-01),
    vec4(3.08701394e-02, -3.94979714e-02, -2.19519088e-02, 4.91367452e-02),
    vec4(1.16693383e-02, -6.32264519e-02, 2.00473215e-03, 1.05505181e-01),
    vec4(3.59266484e-02, 1.42431725e-02, -4.67942932e-02, 1.44974780e-02),
    vec4(4.40952054e-02, -4.75254626e-02, -2.58504277e-02, 9.99064603e-02),
    vec4(-2.18467675e-02, 4.31315447e-02, -1.90322547e-02, -2.82583069e-02),
    vec4(5.05678141e-02, -1.87116449e-02, -4.74351716e-02, 9.11242996e-02),
    vec4(-3.66704911e-02, 9.05032611e-03, 2.69521138e-02, -4.52571369e-02),
    vec4(2.99945480e-02, 1.34535445e-02, -6.03104319e-02, 7.95623659e-02),
    vec4(1.38033849e-02, -3.51336752e-02, 4.01350876e-02, -2.53013170e-02),
    vec4(-4.77933246e-03, 3.89392889e-02, -6.33311298e-02, 6.57258701e-02),
    vec4(3.64253089e-02, -2.64914139e-02, 8.69665720e-03, 1.32113915e-02),
    vec4(-3.45217685e-02, 5.04207856e-02, -5.67563751e-02, 5.01998728e-02),
    vec4(-6.54281304e-03, 1.91035382e-02, -3.01210392e-02, 3.86668490e-02),
    vec4(-4.39454647e-02, 4.53040510e-02, -4.21598921e-02, 3.36245094e-02),
    vec4(-3.52747549e-02, 3.47032417e-02, -3.35501655e-02, 3.17920339e-02),
    vec4(-2.93830896e-02, 2.62344239e-02, -2.21582206e-02, 1.66682013e-02));

struct RimDistribution {
    float coefficient[kNusseltRimNodes];
    float value[kNusseltRimNodes];
    float below[kNusseltRimNodes + 1]; ///< integrals of the linear interpolant up to the nodes, and to 1
    bool is_polynomial;                ///< false: the density is the piecewise linear interpolant
    bool is_exact;                     ///< whether the interpolant differs from the function by rounding only
};

/// \param value of the density at the nodes, not negative, not normalised, of order one or less.
RimDistribution make_rim_distribution(float value[kNusseltRimNodes]) {
    vec4 left0 = vec4(value[7], value[6], value[5], value[4]);
    vec4 left1 = vec4(value[3], value[2], value[1], value[0]);
    vec4 right0 = vec4(value[8], value[9], value[10], value[11]);
    vec4 right1 = vec4(value[12], value[13], value[14], value[15]);
    RimDistribution self;
    NUSSELT_UNROLL for (int k = 0; k < kNusseltRimNodes; k += 2) {
        self.coefficient[k] = dot(kNusseltGegenbauer[2 * k], right0 + left0) +
                              dot(kNusseltGegenbauer[2 * k + 1], right1 + left1);
        self.coefficient[k + 1] = dot(kNusseltGegenbauer[2 * k + 2], right0 - left0) +
                                  dot(kNusseltGegenbauer[2 * k + 3], right1 - left1);
    }
    self.value = value;
    self.below[0] = 0.5 * (kNusseltRimNode[0] + 1.0) * value[0];
    NUSSELT_UNROLL for (int i = 1; i < kNusseltRimNodes; ++i)
        self.below[i] =
            self.below[i - 1] + 0.5 * (kNusseltRimNode[i] - kNusseltRimNode[i - 1]) * (value[i - 1] + value[i]);
    float last = 0.5 * (1.0 - kNusseltRimNode[kNusseltRimNodes - 1]) * value[kNusseltRimNodes - 1];
    self.below[kNusseltRimNodes] = self.below[kNusseltRimNodes - 1] + last;
    // Polynomials whose last two coefficients exceed a fraction of the first one may be negative.
    float tail = abs(self.coefficient[kNusseltRimNodes - 1]) + abs(self.coefficient[kNusseltRimNodes - 2]);
    self.is_polynomial = tail < 1.0e-3 * self.coefficient[0];
    self.is_exact = tail < (16.0 * kNusseltEpsilon) * self.coefficient[0];
    return self;
}

/// The integral of the density.
float rim_distribution_integral(const RimDistribution self) {
    return self.is_polynomial ? (4.0 / 3.0) * self.coefficient[0] : self.below[kNusseltRimNodes];
}

/// Clenshaw's scheme for Gegenbauer's polynomials of parameter 3/2.
float rim_polynomial_value(const RimDistribution self, float z) {
    float current = 0.0;
    float next = 0.0;
    NUSSELT_UNROLL for (int k = kNusseltRimNodes - 1; k >= 0; --k) {
        float lower = nusselt_fma(-float(k + 3) / float(k + 2), next, self.coefficient[k]);
        float sum = nusselt_fma((float(2 * k + 3) / float(k + 1)) * z, current, lower);
        next = current;
        current = sum;
    }
    return nusselt_max((1.0 - z) * (1.0 + z) * current, 0.0);
}

/// The integral from -1 to z, by polynomials of parameter 5/2.
float rim_polynomial_below(const RimDistribution self, float z) {
    float current = 0.0;
    float next = 0.0;
    NUSSELT_UNROLL for (int n = kNusseltRimNodes - 2; n >= 0; --n) {
        float own = (3.0 / float((n + 1) * (n + 4))) * self.coefficient[n + 1];
        float lower = nusselt_fma(-float(n + 5) / float(n + 2), next, own);
        float sum = nusselt_fma((float(2 * n + 5) / float(n + 1)) * z, current, lower);
        next = current;
        current = sum;
    }
    float up = 1.0 + z;
    float down = 1.0 - z;
    return up * up * (self.coefficient[0] * ((2.0 - z) * (1.0 / 3.0)) - down * down * current);
}

/// A piece of the linear interpolant.
struct RimSegment {
    float begin, width, left, right, below;
};

RimSegment rim_first_segment(RimDistribution self) {
    return RimSegment(-1.0, kNusseltRimNode[0] + 1.0, 0.0, self.value[0], 0.0);
}

/// The piece after a node.
RimSegment rim_segment(RimDistribution self, int i) {
    float right = i + 1 < kNusseltRimNodes ? self.value[min(i + 1, kNusseltRimNodes - 1)] : 0.0;
    float width = kNusseltRimNode[i + 1] - kNusseltRimNode[i];
    return RimSegment(kNusseltRimNode[i], width, self.value[i], right, self.below[i]);
}

/// The piece that z in [-1, 1] is in.
RimSegment rim_segment_at(const RimDistribution self, float z) {
    RimSegment s = rim_first_segment(self);
    NUSSELT_UNROLL for (int i = 0; i < kNusseltRimNodes; ++i) {
        if (z >= kNusseltRimNode[i]) s = rim_segment(self, i);
    }
    return s;
}

/// \param u in [0, 1)
/// \return z whose integral from -1 is u times the whole, increasing with u.
float rim_distribution_invert(RimDistribution self, float u) {
    float goal = u * self.below[kNusseltRimNodes];
    RimSegment s = rim_first_segment(self);
    NUSSELT_UNROLL for (int i = 0; i < kNusseltRimNodes; ++i) {
        if (goal >= self.below[i]) s = rim_segment(self, i);
    }
    float rest = nusselt_max(goal - s.below, 0.0) / s.width;
    float root = sqrt(nusselt_max(nusselt_fma(2.0 * (s.right - s.left), rest, s.left * s.left), 0.0));
    float denominator = s.left + root;
    float share = 2.0 * rest / (denominator > 0.0 ? denominator : 1.0);
    float z = nusselt_fma(nusselt_min(share, 1.0), s.width, s.begin);
    if (!self.is_polynomial) return z;
    // Where the interpolants are close enough for the polynomial to be used, two steps have errors below 1e-6.
    goal = u * rim_distribution_integral(self);
    NUSSELT_LOOP for (int i = 0; i < 2; ++i) {
        float slope = rim_polynomial_value(self, z);
        float step = slope > 0.0 ? (rim_polynomial_below(self, z) - goal) / slope : 0.0;
        z = nusselt_min(nusselt_max(z - step, -1.0), 1.0);
    }
    return z;
}

/// \param z in [-1, 1]
float rim_distribution_value(const RimDistribution self, float z) {
    if (self.is_polynomial) return rim_polynomial_value(self, z);
    RimSegment s = rim_segment_at(self, z);
    return nusselt_fma((z - s.begin) / s.width, s.right - s.left, s.left);
}

/// The integral from -1 to z in [-1, 1].
float rim_distribution_below(const RimDistribution self, float z) {
    if (self.is_polynomial) return rim_polynomial_below(self, z);
    RimSegment s = rim_segment_at(self, z);
    float share = (z - s.begin) / s.width;
    return nusselt_fma(s.width * share, nusselt_fma(0.5 * share, s.right - s.left, s.left), s.below);
}

#endif
