#pragma once
/// The references for the errors of techniques.

#include "proof/accuracy/inputs.h"

namespace nusselt::proof {

/// A technique with its reference in long double and the formulas that it replaces.
/// \tparam AnyKind of the registry.
template <class AnyKind>
struct Judged : InputOf<AnyKind> {
    using Kind = AnyKind;
    using Input = InputOf<Kind>;
    static constexpr const char* kName = Kind::kName;
    static constexpr bool kClips = Kind::kHorizon == hostile::Horizon::clipped;
    /// Whether measure() only depends on the part of the light that the shading point sees.
    static constexpr bool kMeasuresVisible = Kind::kMeasure != hostile::Measure::area;
    static constexpr bool kCyclic = Kind::kCyclic;
    static constexpr bool kHasFloor = !Kind::kBiased;
    template <class Real>
    using Plain = typename Kind::template Published<Real>;
    template <class Real>
    using Ours = typename Kind::template Technique<Real>;
    using TwoSteps = typename Kind::template FewSteps<Exact>; ///< as many steps as float, no rounding
    using Reference = typename Kind::template Reference<Exact>;

    /// The unit direction around which the first random number turns.
    static Vec3<Exact> pole(const typename Input::template Light<Exact>& light) {
        if constexpr (hostile::kIsRound<Kind>) {
            // A direction in the light: u.x = 0 and u.x = 1 coincide around the axis of a cone. Where the horizon cuts it, they
            // are opposite ends, which no rounding takes for each other.
            return normalize(light.center);
        } else if constexpr (!hostile::kIsCylinder<Kind>) {
            if constexpr (hostile::kHasLobe<Kind>)
                return normalize(Ltc<Exact>(light.lobe).to_shading({0, 0, 1}));
            else
                return {0, 0, 1};
        } else if constexpr (Kind::kMeasure == hostile::Measure::area) {
            // Here, u.x = 0 and u.x = 1 always coincide.
            return normalize(light.axis.p0 + (light.axis.length / 2) * light.axis.s);
        } else {
            const Vec3<Exact> s = CylinderInput::along_axis(light);
            // If the axis is beyond the horizon of the lobe, azimuths do not go all around it. The opposite direction
            // hits nothing.
            if constexpr (hostile::kHasLobe<Kind>)
                return Ltc<Exact>(light.lobe).to_cosine(s).z > 0 ? s : -s;
            else
                return s;
        }
    }
};

} // namespace nusselt::proof
