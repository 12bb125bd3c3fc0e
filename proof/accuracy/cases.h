#pragma once
/// Single lights of the accuracy tables, with everything needed to judge their samples.

#include "proof/accuracy/references.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace nusselt::proof {

/// Lights dimmer than this are left out: they contribute nothing to an image, but their relative errors may be
/// arbitrary.
inline constexpr Exact kSmallestMeasure = 1e-12L;

/// A light in a number type, with everything needed to judge a method.
template <class Technique, class Real>
struct Case {
    typename Technique::template Light<Real> light;
    typename Technique::template Random<float> u;
    typename Technique::template Light<Exact> exact_light;
    typename Technique::Reference exact;
    bool cyclic; ///< whether u = 0 and u = 1 coincide

    /// The difference between two values of the first random number.
    Exact difference(Exact a, Exact b) const {
        const Exact apart = std::fabs(a - b);
        return cyclic ? std::min(apart, 1 - apart) : apart;
    }

    /// Angle by which a unit direction misses the visible part of the light, 0 or less on it.
    Exact missed_by(const Vec3<Exact>& wi) const {
        const Exact below_horizon = Technique::kClips ? -wi.z : Exact{0};
        return std::max(Technique::miss(exact_light, wi), below_horizon);
    }
};

/// Four roundings of the method plus the error of the reference itself.
template <class Real>
inline constexpr Exact kTolerance = 4 * Exact{std::numeric_limits<Real>::epsilon()} +
                                    16 * std::numeric_limits<Exact>::epsilon();

/// Whether the technique has nothing to sample.
template <class Technique>
bool is_dark(const typename Technique::Class& lights) {
    return lights.visibility == Visibility::no_one ||
           (lights.visibility == Visibility::no_one_above_horizon && Technique::kClips);
}

/// The lights of a class with numbers from `begin` to `end`, without those that are too dim.
template <class Technique, class Real>
std::vector<Case<Technique, Real>> make_cases(const typename Technique::Class& lights, int begin, int end) {
    std::vector<Case<Technique, Real>> cases;
    for (int i = begin; i < end; ++i) {
        // Both only depend on the number of the light, so that related classes have related lights.
        Engine light_engine(2 * static_cast<std::uint64_t>(i));
        Engine random_engine(2 * static_cast<std::uint64_t>(i) + 1);
        const auto light = Technique::template make<Real>(lights.make(light_engine));
        const auto exact_light = Technique::template exact<Real>(light);
        const auto uniform = [&] {
            return std::uniform_real_distribution<float>(0, 0.999999f)(random_engine);
        };
        Case<Technique, Real> c{light, Technique::random(uniform), exact_light,
                                typename Technique::Reference(exact_light), false};
        if (!is_dark<Technique>(lights) && !(c.exact.measure() > kSmallestMeasure)) continue;
        if constexpr (Technique::kCyclic)
            c.cyclic = !(c.missed_by(Technique::pole(exact_light)) > kTolerance<float>);
        cases.push_back(c);
    }
    return cases;
}

} // namespace nusselt::proof
