#pragma once
/// Techniques for cylinders, with and without lobes.

#include "inputs/cylinder_lights.h"
#include "ltc_parity.h"

#include <algorithm>
#include <cmath>

namespace nusselt::parity {

inline const auto& classes_of(const CylinderClass*) { return cylinder_classes(); }
inline bool is_judged_with_bound(const CylinderClass&, int) { return true; }
inline bool is_judged_with_bound(const OnLobes<CylinderClass>&, int) { return true; }

/// Cylinders as techniques take them.
struct CylinderInput {
    using Exact = proof::Exact;
    using Class = CylinderClass;
    static constexpr int kVertexBound = 2;
    template <class Real>
    using Light = Cylinder<Real>;
    template <class Real>
    using Random = Vec2<Real>;

    template <class Real>
    static Light<Real> make(const Cylinder<float>& source) {
        return {proof::LineInput::make<Real>(source.axis), source.radius};
    }
    template <class Real>
    static Light<Exact> exact(const Light<Real>& rounded) {
        return {proof::LineInput::exact<Real>(rounded.axis), rounded.radius};
    }
    /// Angle by which a unit direction misses a light, 0 on it.
    static Exact miss(const Light<Exact>& light, const Vec3<Exact>& wi) {
        if (intersect(light, wi).hits) return 0;
        // The ray to the point that is closest to its ray, seen from the origin: the quotient has one minimum.
        Exact low = 0;
        Exact high = length(light.axis.p0) + light.axis.length + light.radius;
        const auto angle = [&](Exact t) { return distance_to(light, t * wi) / t; };
        for (int i = 0; i < 200; ++i) {
            const Exact left = low + (high - low) / 3;
            const Exact right = high - (high - low) / 3;
            (angle(left) < angle(right) ? high : low) = angle(left) < angle(right) ? right : left;
        }
        return std::max(angle(high), Exact{0});
    }
    template <class Uniform>
    static Random<float> random(Uniform uniform) {
        const float x = uniform();
        return {x, uniform()};
    }
    template <class Real>
    static Random<Real> widened(const Random<float>& u) {
        return broadcast<Real>(u);
    }
    template <class Real>
    static Real first(const Random<Real>& u) {
        return u.x;
    }

    /// Direction of the axis, to the nearer cap: where it hits the cylinder, azimuths go all around it.
    static Vec3<Exact> along_axis(const Light<Exact>& light) {
        return dot(light.axis.p0, light.axis.s) > 0 ? light.axis.s : -light.axis.s;
    }

private:
    static Exact distance_to(const Light<Exact>& light, const Vec3<Exact>& p) {
        const Vec3<Exact> offset = p - light.axis.p0;
        const Exact along = dot(offset, light.axis.s);
        const Exact beyond = std::max(-along, along - light.axis.length);
        const Exact outwards = length(cross(offset, light.axis.s)) - light.radius;
        return std::hypot(std::max(beyond, Exact{0}), std::max(outwards, Exact{0}));
    }
};

template <class AnyKind>
struct CylinderTraits : proof::CommonTraits, CylinderInput {
    static constexpr const char* kName = AnyKind::kName;
    static constexpr bool kClips = AnyKind::kHorizon == hostile::Horizon::kClipped;
    static constexpr bool kCyclic = true;
    template <class Real>
    using Ours = typename AnyKind::template Technique<Real>;
    using Reference = Ours<Exact>;

    static Vec3<Exact> pole(const Light<Exact>& light) { return along_axis(light); }
};

/// u.x = 0 and u.x = 1 are always the same.
struct CylinderAreaTraits : CylinderTraits<hostile::CylinderAreaKind> {
    static constexpr bool kMeasuresVisible = false;

    static Vec3<Exact> pole(const Light<Exact>& light) {
        return normalize(light.axis.p0 + (light.axis.length / 2) * light.axis.s);
    }
};

struct CylinderLtcTraits : OnLobeTraits<CylinderInput, hostile::CylinderLtcKind> {
    static constexpr bool kCyclic = true;

    /// Beyond the horizon of the lobe there are no azimuths all around: the opposite direction hits nothing.
    static Vec3<Exact> pole(const Light<Exact>& light) {
        const Vec3<Exact> s = CylinderInput::along_axis(light);
        return Ltc<Exact>(light.lobe).to_cosine(s).z > 0 ? s : -s;
    }
};

using CylinderSolidAnglePair =
    TechniquePair<CylinderTraits<hostile::CylinderSolidAngleKind>, hostile::CylinderSolidAngleKind>;
using CylinderProjectedSolidAnglePair =
    TechniquePair<CylinderTraits<hostile::CylinderProjectedSolidAngleKind>,
                  hostile::CylinderProjectedSolidAngleKind>;
using CylinderLtcPair = TechniquePair<CylinderLtcTraits, hostile::CylinderLtcKind>;

/// Half of the samples or more are no samples: those on the side that faces away.
struct CylinderAreaPair : TechniquePair<CylinderAreaTraits, hostile::CylinderAreaKind> {
    using Case = proof::Case<CylinderAreaTraits, float>;

    /// Where rounding decides which side a point is on, nothing is asked.
    static constexpr proof::Exact kGrazing = 1e-3L;

    static void judge(const Case& c, bool dark, const Outputs& out, Errors& errors) {
        const auto facing = cosine_of(c);
        if (!dark && std::fabs(facing) < kGrazing) return;
        parity::judge(c, dark || facing < 0, out, errors);
    }

private:
    /// Between the ray to the sample, backwards, and the normal there.
    static proof::Exact cosine_of(const Case& c) {
        const auto& [axis, radius] = c.exact_light;
        const auto p = c.exact.sample(CylinderInput::widened<proof::Exact>(c.u)).p;
        const auto from_begin = p - axis.p0;
        const auto along = dot(from_begin, axis.s);
        const auto across = from_begin - along * axis.s;
        const auto to_ends = std::min(along, axis.length - along);
        const auto on_cap = along < axis.length / 2 ? -axis.s : axis.s;
        const auto normal = radius - length(across) < to_ends ? normalize(across) : on_cap;
        return -dot(normalize(p), normal);
    }
};

} // namespace nusselt::parity
