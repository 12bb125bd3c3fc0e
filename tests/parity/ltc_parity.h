#pragma once
/// Techniques for linearly transformed cosines: lights of the accuracy tables, each with a lobe of the shipped table.

#include "inputs/lobes.h"
#include "technique_parity.h"

#include <random>
#include <vector>

namespace nusselt::parity {

/// A class of lights, on lobes.
/// \tparam Base of proof/accuracy/lights.h.
template <class Base>
struct OnLobes {
    const Base* base;
    const char* name = base->name;
    proof::Visibility visibility = base->visibility;

    auto make(proof::Engine& engine) const {
        struct Light {
            decltype(base->make(engine)) light;
            LtcCoefficients<float> lobe;
        };
        const auto light = base->make(engine);
        return Light{light,
                     lobe_of_table([&] { return std::uniform_real_distribution<float>(0, 1)(engine); })};
    }
};

template <class Base>
const std::vector<OnLobes<Base>>& classes_of(const OnLobes<Base>*) {
    static const std::vector<OnLobes<Base>> classes = [] {
        std::vector<OnLobes<Base>> result;
        for (const Base& base : classes_of(static_cast<const Base*>(nullptr))) {
            result.push_back({&base});
            // These lie in front of the eye, from where lobes lean.
            if (base.name == std::string_view("in the horizon plane"))
                result.back().visibility = proof::Visibility::no_one;
        }
        return result;
    }();
    return classes;
}

/// Polygons with more vertices need the larger bound.
inline bool is_judged_with_bound(const OnLobes<proof::PolygonClass>& lights, int bound) {
    const int vertices = lights.base->vertex_count;
    return bound == 4 ? vertices <= 4 : 4 < vertices && vertices <= bound;
}
inline bool is_judged_with_bound(const OnLobes<proof::LineClass>&, int) { return true; }

/// \tparam Input of proof/accuracy/references.h, of the geometry.
/// \tparam Kind  of proof/hostile/techniques.h.
template <class Input, class Kind>
struct OnLobeTraits : proof::CommonTraits {
    using Exact = proof::Exact;
    using Class = OnLobes<typename Input::Class>;
    static constexpr int kVertexBound = Input::kVertexBound;
    static constexpr const char* kName = Kind::kName;
    static constexpr bool kClips = Kind::kHorizon == hostile::Horizon::kClipped;
    static constexpr bool kCyclic = hostile::kIsPolygon<Kind>;
    template <class Real>
    using Light = typename Kind::template Light<Real>;
    template <class Real>
    using Random = typename Kind::template Random<Real>;
    template <class Real>
    using Ours = typename Kind::template Technique<Real>;
    using Reference = Ours<Exact>;

    template <class Real, class Source>
    static Light<Real> make(const Source& source) {
        return {Input::template make<Real>(source.light), widened_lobe<Real>(source.lobe)};
    }
    template <class Real>
    static Light<Exact> exact(const Light<Real>& light) {
        return {Input::template exact<Real>(light), widened_lobe<Exact>(light.lobe)};
    }
    static Exact miss(const Light<Exact>& light, const Vec3<Exact>& wi) { return Input::miss(light, wi); }
    static Vec3<Exact> pole(const Light<Exact>& light) {
        return normalize(Ltc<Exact>(light.lobe).to_shading({0, 0, 1}));
    }

    template <class Uniform>
    static Random<float> random(Uniform uniform) {
        return Input::random(uniform);
    }
    template <class Real>
    static Random<Real> widened(const Random<float>& u) {
        return Input::template widened<Real>(u);
    }
    template <class Real>
    static Real first(const Random<Real>& u) {
        return Input::template first<Real>(u);
    }
};

template <int N>
using PolygonLtcPair = TechniquePair<OnLobeTraits<proof::PolygonInput<N>, hostile::PolygonLtcKindOf<N>>,
                                     hostile::PolygonLtcKindOf<N>>;
template <int N>
using PolygonClippedLtcPair =
    TechniquePair<OnLobeTraits<proof::PolygonInput<N>, hostile::PolygonClippedLtcKindOf<N>>,
                  hostile::PolygonClippedLtcKindOf<N>>;
using LineLtcPair = TechniquePair<OnLobeTraits<proof::LineInput, hostile::LineLtcKind>, hostile::LineLtcKind>;
using LineClippedLtcPair =
    TechniquePair<OnLobeTraits<proof::LineInput, hostile::LineClippedLtcKind>, hostile::LineClippedLtcKind>;

} // namespace nusselt::parity
