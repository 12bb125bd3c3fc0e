#ifndef NUSSELT_ESTIMATE_MIS_GLSL
#define NUSSELT_ESTIMATE_MIS_GLSL
// Follows include/nusselt/estimate/mis.h @ 898a2602ada1
/// Multiple importance sampling (MIS): how samples of two techniques make one estimate. Twin of
/// include/nusselt/estimate/mis.h, where the sources stand.
///
/// The integrand is a sum of two components, the BRDF times cosine of the diffuse part (0) and of a lobe (1). Technique
/// k samples with density p_k, which is nearly proportional to component k over the light. Its coefficient c_k
/// estimates the integral of that component over the light without shadows. If both are exact, the integrand is the sum
/// of c_k p_k.

#include "../core/real.glsl"

/// Smallest diffuse albedo to form coefficients with. Lobes are zero in a part of the hemisphere; the technique for the
/// diffuse component has to take over there, also on metals.
const float kNusseltSmallestDiffuseAlbedo = 0.01;

/// The knowledge that heuristics have beforehand about both techniques, for one light and shading point.
struct MisTechniques {
    float samples[2];   ///< n_k > 0, how many samples each technique takes
    vec3 unshadowed[2]; ///< c_k >= 0 per colour channel, for a radiance of 1; 0 for a technique that cannot sample
};

/// A direction that one of the techniques has sampled.
struct MisSample {
    float pdf[2];      ///< densities p_k of both techniques, in one measure; 0 for a technique that cannot sample
    vec3 component[2]; ///< of the BRDF times cosine, per colour channel; zero below the surface
};

/// The share of one sample in the estimate. The sum over all samples of both techniques of `shadowed` times visibility
/// plus `constant`, times the radiance of the light, is unbiased.
struct MisEstimate {
    vec3 shadowed;
    vec3 constant; ///< counts whether or not the light is visible
};

/// Finite if both are. Denormal denominators, whose reciprocals are not, count as 0: as good as no sample has them.
float ratio_or_zero(float numerator, float denominator) {
    if (denominator < 1.17549435082228751e-38) return 0.0;
    float ratio = numerator / denominator;
    // NaN stays what it is, so that it is noticed.
    return ratio > kNusseltLargest ? kNusseltLargest : ratio;
}
vec3 ratio_or_zero(vec3 numerator, vec3 denominator) {
    return vec3(ratio_or_zero(numerator.x, denominator.x), ratio_or_zero(numerator.y, denominator.y),
                ratio_or_zero(numerator.z, denominator.z));
}

/// Sum of n_k p_k: the density of all samples taken together.
float total_density(const MisTechniques techniques, const MisSample at) {
    return nusselt_fma(techniques.samples[1], at.pdf[1], techniques.samples[0] * at.pdf[0]);
}

/// Sum of c_k p_k: what the integrand ought to be.
vec3 expected_integrand(const MisTechniques techniques, const MisSample at) {
    return nusselt_fma(at.pdf[1], techniques.unshadowed[1], at.pdf[0] * techniques.unshadowed[0]);
}

/// c_k / n_k.
vec3 mis_coefficient(const MisTechniques techniques, int k) {
    float samples = k == 0 ? techniques.samples[0] : techniques.samples[1];
    return (1.0 / samples) * (k == 0 ? techniques.unshadowed[0] : techniques.unshadowed[1]);
}

/// n_k p_k.
float mis_density(const MisTechniques techniques, const MisSample at, int k) {
    return k == 0 ? techniques.samples[0] * at.pdf[0] : techniques.samples[1] * at.pdf[1];
}

// All heuristics are functions of the techniques and of a sample, its densities and components; most depend on the
// technique `drawn`, 0 or 1, that has sampled it. They are unbiased for any coefficients c_k >= 0 that do not depend on
// the samples, as long as some n_k p_k (balance, power, optimal, clamped optimal with v < 1), some c_k p_k (weighted
// balance, clamped optimal with v = 1) or p_0 (separate) is positive wherever the integrand is not zero. For the
// optimal heuristic, densities must integrate to 1.

/// Weights proportional to n_k p_k.
MisEstimate balance_heuristic(const MisTechniques techniques, const MisSample at) {
    float factor = ratio_or_zero(1.0, total_density(techniques, at));
    return MisEstimate(factor * (at.component[0] + at.component[1]), vec3(0.0));
}

/// Weights proportional to the square of n_k p_k.
MisEstimate power_heuristic(int drawn, const MisTechniques techniques, const MisSample at) {
    // Relative to their sum, the squares of densities neither overflow nor vanish.
    float scale = ratio_or_zero(1.0, total_density(techniques, at));
    float share0 = scale * mis_density(techniques, at, 0);
    float share1 = scale * mis_density(techniques, at, 1);
    float squares = nusselt_fma(share1, share1, share0 * share0);
    float factor = scale * ratio_or_zero(drawn == 0 ? share0 : share1, squares);
    return MisEstimate(factor * (at.component[0] + at.component[1]), vec3(0.0));
}

/// Weights proportional to c_k p_k: no noise at all where the coefficients are right and nothing casts a shadow.
/// Penumbrae suffer where the coefficient of a technique is small.
MisEstimate weighted_balance_heuristic(int drawn, const MisTechniques techniques, const MisSample at) {
    vec3 factor = ratio_or_zero(mis_coefficient(techniques, drawn), expected_integrand(techniques, at));
    return MisEstimate(factor * (at.component[0] + at.component[1]), vec3(0.0));
}

/// A blend of weighted balance and balance heuristic: the robust choice.
/// \param visibility v in [0, 1], an estimate of the visible share of the light; 0.5 is a good one.
MisEstimate clamped_optimal_heuristic(int drawn, float visibility, const MisTechniques techniques, const MisSample at) {
    vec3 weighted = weighted_balance_heuristic(drawn, techniques, at).shadowed;
    vec3 balanced = balance_heuristic(techniques, at).shadowed;
    return MisEstimate(nusselt_fma(visibility, weighted, (1.0 - visibility) * balanced), vec3(0.0));
}

/// Optimal MIS: the sum of v c_k p_k is a control variate. Least variance if v is right everywhere; estimates can be
/// negative.
/// \param visibility v in [0, 1], an estimate of the visible share of the light.
MisEstimate optimal_heuristic(int drawn, float visibility, const MisTechniques techniques, const MisSample at) {
    float factor = ratio_or_zero(1.0, total_density(techniques, at));
    vec3 expected = factor * expected_integrand(techniques, at);
    return MisEstimate(factor * (at.component[0] + at.component[1]),
                       visibility * (mis_coefficient(techniques, drawn) - expected));
}

/// Each technique estimates its own component only, for comparison: the noise of the components adds up. What technique
/// 1 cannot sample of component 1 is left to technique 0, so that nothing gets lost.
MisEstimate separate_components(int drawn, const MisTechniques techniques, const MisSample at) {
    float factor = ratio_or_zero(1.0, mis_density(techniques, at, drawn));
    vec3 component = at.component[1];
    if (drawn == 0) component = at.component[0] + (at.pdf[1] > 0.0 ? vec3(0.0) : at.component[1]);
    return MisEstimate(factor * component, vec3(0.0));
}

// Numbers of the heuristics, those of `enum class Mis` of the renderers.
const int kNusseltMisBalance = 0;
const int kNusseltMisPower = 1;
const int kNusseltMisWeightedBalance = 2;
const int kNusseltMisClampedOptimal = 3;
const int kNusseltMisOptimal = 4;
const int kNusseltMisOneSample = 5; ///< not one of mis_estimate(), see OneSampleChoice
const int kNusseltMisSeparate = 6;

/// The estimate of a heuristic that a specialisation constant may choose.
/// \param heuristic  kNusseltMis*, but not kNusseltMisOneSample.
/// \param drawn      the technique that has sampled, 0 or 1.
/// \param visibility of the optimal heuristics; the others have no use for it.
MisEstimate mis_estimate(int heuristic, int drawn, float visibility, const MisTechniques techniques,
                         const MisSample at) {
    switch (heuristic) {
    case kNusseltMisBalance:
        return balance_heuristic(techniques, at);
    case kNusseltMisPower:
        return power_heuristic(drawn, techniques, at);
    case kNusseltMisWeightedBalance:
        return weighted_balance_heuristic(drawn, techniques, at);
    case kNusseltMisOptimal:
        return optimal_heuristic(drawn, visibility, techniques, at);
    case kNusseltMisSeparate:
        return separate_components(drawn, techniques, at);
    }
    return clamped_optimal_heuristic(drawn, visibility, techniques, at);
}

/// One sample of one technique, chosen in proportion to the luminance of its coefficient. Lacks samples of the diffuse
/// technique where something shadows a highlight.
struct OneSampleChoice {
    float probability[2]; ///< to choose each technique; both are 0 if there is no light
};

/// \param techniques the numbers of samples are not used.
OneSampleChoice one_sample_choice_prepare(const MisTechniques techniques) {
    const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
    float luminance0 = dot(kLuminance, techniques.unshadowed[0]);
    float luminance1 = dot(kLuminance, techniques.unshadowed[1]);
    float sum = luminance0 + luminance1;
    return OneSampleChoice(float[2](ratio_or_zero(luminance0, sum), ratio_or_zero(luminance1, sum)));
}

/// A random number decides for one technique and remains random.
struct OneSampleDecision {
    int chosen; ///< 0 or 1, the latter if there is no light
    float u;    ///< in [0, 1), independent of the decision
};

/// \param u in [0, 1).
OneSampleDecision one_sample_choice_decide(const OneSampleChoice self, float u) {
    if (u < self.probability[0]) return OneSampleDecision(0, below_one(ratio_or_zero(u, self.probability[0])));
    return OneSampleDecision(1, below_one(ratio_or_zero(u - self.probability[0], self.probability[1])));
}

/// The estimate of that sample.
MisEstimate one_sample_choice_estimate(const OneSampleChoice self, const MisSample at) {
    float density = nusselt_fma(self.probability[1], at.pdf[1], self.probability[0] * at.pdf[0]);
    return MisEstimate(ratio_or_zero(1.0, density) * (at.component[0] + at.component[1]), vec3(0.0));
}

#endif
