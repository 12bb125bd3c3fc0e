#pragma once
/// Multiple importance sampling (MIS): how samples of several techniques make one estimate.
///
/// E. Veach, L. Guibas 1995, Optimally Combining Sampling Techniques for Monte Carlo Rendering,
/// doi:10.1145/218380.218498; I. Kondapaneni et al. 2019, Optimal Multiple Importance Sampling,
/// doi:10.1145/3306346.3323009; C. Peters 2021, BRDF Importance Sampling for Polygonal Lights,
/// doi:10.1145/3450626.3459672, Sec. 4.2 and 4.3 with supplement B (re-derived).
///
/// The integrand is a sum of components, the BRDF times cosine of the diffuse part and of each lobe. Technique k samples
/// with density p_k, which is nearly proportional to component k over the light. Its coefficient c_k estimates the
/// integral of that component over the light without shadows. If both are exact, the integrand is the sum of c_k p_k.

#include <nusselt/core/vec.h>

NUSSELT_NAMESPACE_BEGIN

/// Smallest diffuse albedo to form coefficients with. Lobes are zero in a part of the hemisphere; the technique for the
/// diffuse component has to take over there, also on metals (Peters 2021, Sec. 4.2).
inline constexpr double kSmallestDiffuseAlbedo = 0.01;

/// The knowledge that heuristics have beforehand about K techniques, for one light and shading point.
template <class Real, int K>
struct MisTechniques {
    Real samples[K]; ///< n_k > 0, how many samples each technique takes
    Vec3<Real> unshadowed
        [K]; ///< c_k >= 0 per colour channel, for a radiance of 1; 0 for a technique that cannot sample
};

/// A direction that one of K techniques has sampled.
template <class Real, int K>
struct MisSample {
    Real pdf[K]; ///< densities p_k of all techniques, in one measure; 0 for a technique that cannot sample
    Vec3<Real> component[K]; ///< of the BRDF times cosine, per colour channel; zero below the surface
};

/// The share of one sample in the estimate. The sum over all samples of all techniques of `shadowed` times visibility
/// plus `constant`, times the radiance of the light, is unbiased.
template <class Real>
struct MisEstimate {
    Vec3<Real> shadowed;
    Vec3<Real> constant; ///< counts whether or not the light is visible
};

namespace detail {

template <class Real, int K>
NUSSELT_HD inline Vec3<Real> sum_of(const Vec3<Real> (&terms)[K]) noexcept {
    Vec3<Real> sum = terms[0];
    for (int k = 1; k < K; ++k) sum = sum + terms[k];
    return sum;
}

/// Finite if both are. Denormal denominators, whose reciprocals are not, count as 0: as good as no sample has them.
template <class Real>
NUSSELT_HD inline Real ratio_or_zero(const Real& numerator, const Real& denominator) noexcept {
    using Limits = std::numeric_limits<scalar_t<Real>>;
    const auto vanishes = denominator < Real(Limits::min());
    const Real ratio = numerator / select(vanishes, Real(1), denominator);
    // NaN stays what it is, so that it is noticed.
    const auto overflows = ratio > Real(Limits::max());
    return select(vanishes, Real(0), select(overflows, Real(Limits::max()), ratio));
}

template <class Real>
NUSSELT_HD inline Vec3<Real> ratio_or_zero(const Vec3<Real>& numerator,
                                           const Vec3<Real>& denominator) noexcept {
    return {ratio_or_zero(numerator.x, denominator.x), ratio_or_zero(numerator.y, denominator.y),
            ratio_or_zero(numerator.z, denominator.z)};
}

/// Sum of n_k p_k: the density of all samples taken together.
template <class Real, int K>
NUSSELT_HD inline Real total_density(const MisTechniques<Real, K>& techniques,
                                     const MisSample<Real, K>& sample) noexcept {
    Real sum = techniques.samples[0] * sample.pdf[0];
    for (int k = 1; k < K; ++k) sum = fma(techniques.samples[k], sample.pdf[k], sum);
    return sum;
}

/// Sum of c_k p_k: what the integrand ought to be.
template <class Real, int K>
NUSSELT_HD inline Vec3<Real> expected_integrand(const MisTechniques<Real, K>& techniques,
                                                const MisSample<Real, K>& sample) noexcept {
    Vec3<Real> sum = sample.pdf[0] * techniques.unshadowed[0];
    for (int k = 1; k < K; ++k) sum = fma(sample.pdf[k], techniques.unshadowed[k], sum);
    return sum;
}

} // namespace detail

// All heuristics are functions of the techniques, a sample of technique J, and its densities and components. They are
// unbiased for any coefficients c_k >= 0 that do not depend on the samples, as long as some n_k p_k (balance, power,
// optimal, clamped optimal with v < 1), some c_k p_k (weighted balance, clamped optimal with v = 1) or p_0 (separate)
// is positive wherever the integrand is not zero. For the optimal heuristic, densities must integrate to 1.

/// Weights proportional to n_k p_k (Veach and Guibas 1995).
struct BalanceHeuristic {
    template <int J, class Real, int K>
    NUSSELT_HD MisEstimate<Real> estimate(const MisTechniques<Real, K>& techniques,
                                          const MisSample<Real, K>& sample) const noexcept {
        const Real factor = detail::ratio_or_zero(Real(1), detail::total_density(techniques, sample));
        return {factor * detail::sum_of(sample.component), {Real(0), Real(0), Real(0)}};
    }
};

/// Weights proportional to the square of n_k p_k (Veach and Guibas 1995).
struct PowerHeuristic {
    template <int J, class Real, int K>
    NUSSELT_HD MisEstimate<Real> estimate(const MisTechniques<Real, K>& techniques,
                                          const MisSample<Real, K>& sample) const noexcept {
        // Relative to their sum, the squares of densities neither overflow nor vanish.
        const Real scale = detail::ratio_or_zero(Real(1), detail::total_density(techniques, sample));
        Real squares = Real(0);
        for (int k = 0; k < K; ++k) {
            const Real share = scale * (techniques.samples[k] * sample.pdf[k]);
            squares = fma(share, share, squares);
        }
        const Real share = scale * (techniques.samples[J] * sample.pdf[J]);
        const Real factor = scale * detail::ratio_or_zero(share, squares);
        return {factor * detail::sum_of(sample.component), {Real(0), Real(0), Real(0)}};
    }
};

/// Weights proportional to c_k p_k: no noise at all where the coefficients are right and nothing casts a shadow (Peters
/// 2021, Sec. 4.2). Penumbrae suffer where the coefficient of a technique is small.
struct WeightedBalanceHeuristic {
    template <int J, class Real, int K>
    NUSSELT_HD MisEstimate<Real> estimate(const MisTechniques<Real, K>& techniques,
                                          const MisSample<Real, K>& sample) const noexcept {
        const Vec3<Real> factor =
            detail::ratio_or_zero((Real(1) / techniques.samples[J]) * techniques.unshadowed[J],
                                  detail::expected_integrand(techniques, sample));
        return {factor * detail::sum_of(sample.component), {Real(0), Real(0), Real(0)}};
    }
};

/// A blend of weighted balance and balance heuristic: the robust choice (Peters 2021, Sec. 4.3).
template <class Real>
struct ClampedOptimalHeuristic {
    Real visibility; ///< v in [0, 1], an estimate of the visible share of the light; 0.5 is a good one

    template <int J, int K>
    NUSSELT_HD MisEstimate<Real> estimate(const MisTechniques<Real, K>& techniques,
                                          const MisSample<Real, K>& sample) const noexcept {
        const MisEstimate<Real> weighted =
            WeightedBalanceHeuristic().template estimate<J>(techniques, sample);
        const MisEstimate<Real> balanced = BalanceHeuristic().template estimate<J>(techniques, sample);
        return {fma(visibility, weighted.shadowed, (Real(1) - visibility) * balanced.shadowed),
                {Real(0), Real(0), Real(0)}};
    }
};

/// Optimal MIS: the sum of v c_k p_k is a control variate. Least variance if v is right everywhere; estimates can be
/// negative (Kondapaneni et al. 2019; that no linear system has to be solved is Peters 2021, supplement B).
template <class Real>
struct OptimalHeuristic {
    Real visibility; ///< v in [0, 1], an estimate of the visible share of the light

    template <int J, int K>
    NUSSELT_HD MisEstimate<Real> estimate(const MisTechniques<Real, K>& techniques,
                                          const MisSample<Real, K>& sample) const noexcept {
        const Real factor = detail::ratio_or_zero(Real(1), detail::total_density(techniques, sample));
        const Vec3<Real> expected = factor * detail::expected_integrand(techniques, sample);
        const Vec3<Real> coefficient = (Real(1) / techniques.samples[J]) * techniques.unshadowed[J];
        return {factor * detail::sum_of(sample.component), visibility * (coefficient - expected)};
    }
};

/// Each technique estimates its own component only, for comparison: the noise of the components adds up. What technique
/// k > 0 cannot sample of component k is left to technique 0, so that nothing gets lost.
struct SeparateComponents {
    template <int J, class Real, int K>
    NUSSELT_HD MisEstimate<Real> estimate(const MisTechniques<Real, K>& techniques,
                                          const MisSample<Real, K>& sample) const noexcept {
        const Real factor = detail::ratio_or_zero(Real(1), techniques.samples[J] * sample.pdf[J]);
        Vec3<Real> component = sample.component[J];
        if constexpr (J == 0) {
            const Vec3<Real> zero{Real(0), Real(0), Real(0)};
            for (int k = 1; k < K; ++k)
                component = component + select(sample.pdf[k] > Real(0), zero, sample.component[k]);
        }
        return {factor * component, {Real(0), Real(0), Real(0)}};
    }
};

/// One sample of one technique, chosen in proportion to the luminance of its coefficient (Veach and Guibas 1995, Sec.
/// 4.2; Peters 2021, Sec. 4.2). Lacks samples of the diffuse technique where something shadows a highlight.
template <class Real, int K>
class OneSampleChoice {
public:
    /// \param techniques the numbers of samples are not used.
    NUSSELT_HD explicit OneSampleChoice(const MisTechniques<Real, K>& techniques) noexcept {
        Real sum = Real(0);
        for (int k = 0; k < K; ++k) {
            const Vec3<Real>& c = techniques.unshadowed[k];
            probability_[k] = Real(scalar_t<Real>(0.2126)) * c.x + Real(scalar_t<Real>(0.7152)) * c.y +
                              Real(scalar_t<Real>(0.0722)) * c.z;
            sum = sum + probability_[k];
        }
        for (int k = 0; k < K; ++k) probability_[k] = detail::ratio_or_zero(probability_[k], sum);
    }

    /// Probability to choose technique k; all are 0 if there is no light.
    NUSSELT_HD const Real& probability(int k) const noexcept { return probability_[k]; }

    /// A random number decides for one technique and remains random.
    struct Decision {
        mask_t<Real> chosen[K]; ///< exactly one per lane, the last one if there is no light
        Real u;                 ///< in [0, 1), independent of the decision
    };

    /// \param u in [0, 1).
    NUSSELT_HD Decision decide(const Real& u) const noexcept {
        Decision decision;
        decision.u = u;
        Real begin = Real(0);
        mask_t<Real> open = mask_t<Real>(true);
        for (int k = 0; k < K; ++k) {
            const Real end = k + 1 < K ? begin + probability_[k] : Real(2);
            decision.chosen[k] = open & (u < end);
            open = open & !decision.chosen[k];
            const Real local = detail::ratio_or_zero(u - begin, probability_[k]);
            decision.u = select(decision.chosen[k], below_one(local), decision.u);
            begin = end;
        }
        return decision;
    }

    /// \copydoc BalanceHeuristic::estimate
    NUSSELT_HD MisEstimate<Real> estimate(const MisSample<Real, K>& sample) const noexcept {
        Real density = probability_[0] * sample.pdf[0];
        for (int k = 1; k < K; ++k) density = fma(probability_[k], sample.pdf[k], density);
        return {detail::ratio_or_zero(Real(1), density) * detail::sum_of(sample.component),
                {Real(0), Real(0), Real(0)}};
    }

private:
    Real probability_[K];
};

NUSSELT_NAMESPACE_END
