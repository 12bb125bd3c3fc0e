#pragma once
/// Lights of the accuracy tables in the types that techniques take, and the angles by which directions miss them.

#include "proof/accuracy/lights.h"
#include "proof/accuracy/row.h"
#include "proof/hostile/round_reference.h"
#include "proof/techniques/registry.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace nusselt::proof {

/// Two random numbers for each sample.
struct PairInput {
    template <class Real>
    using Random = Vec2<Real>;

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
};

/// Polygons for techniques with a bound of N vertices.
template <int N>
struct PolygonInput : PairInput {
    using Class = PolygonClass;
    static constexpr int kVertexBound = N;
    template <class Real>
    using Light = ConvexPolygon<Real, N>;

    /// The transcriptions of the papers do not support unused vertex slots.
    static bool fits_plain(const PolygonClass& lights) { return lights.vertex_count == N; }

    /// The light in a number type. As in to_shading_space(), the edges determine the positions.
    template <class Real>
    static Light<Real> make(const PolygonLight& source) {
        const Vec3<Exact> zero{0, 0, 0};
        Light<Real> light;
        light.vertex[0] = broadcast<Real>(source.first);
        Vec3<Exact> sum = zero;
        for (int j = 0; j + 1 < N; ++j) {
            const Vec3<Exact> edge = j + 1 < source.count ? broadcast<Exact>(source.edge[j]) : zero;
            light.edge[j] = broadcast<Real>(edge);
            light.vertex[j + 1] = light.vertex[j] + light.edge[j];
            sum = sum + edge;
        }
        light.edge[N - 1] = broadcast<Real>(-sum);
        light.normal = normalize(doubled_area_normal(light));
        return light;
    }

    /// The light that the first vertex and the edges describe, without rounding.
    template <class Real>
    static Light<Exact> exact(const Light<Real>& rounded) {
        Light<Exact> light;
        light.vertex[0] = broadcast<Exact>(rounded.vertex[0]);
        Vec3<Exact> sum{0, 0, 0};
        for (int j = 0; j + 1 < N; ++j) {
            light.edge[j] = broadcast<Exact>(rounded.edge[j]);
            light.vertex[j + 1] = light.vertex[j] + light.edge[j];
            sum = sum + light.edge[j];
        }
        light.edge[N - 1] = -sum;
        light.normal = normalize(doubled_area_normal(light));
        return light;
    }

    /// Angle by which a unit direction misses a light, 0 on it.
    static Exact miss(const Light<Exact>& light, const Vec3<Exact>& wi) {
        const Exact side = dot(light.normal, light.vertex[0]) < 0 ? -1 : 1;
        Exact worst = 0;
        for (int j = 0; j < N; ++j) {
            const Vec3<Exact> n = cross(light.vertex[j], light.edge[j]);
            const Exact norm = length(n);
            if (norm > 0) worst = std::max(worst, -side * dot(n, wi) / norm);
        }
        return worst;
    }
};

/// Lines, with the same functions as PolygonInput.
struct LineInput {
    using Class = LineClass;
    static constexpr int kVertexBound = 2;
    template <class Real>
    using Light = LineSegment<Real>;
    template <class Real>
    using Random = Real;

    static bool fits_plain(const LineClass&) { return true; }

    /// The direction is computed in the number type, in which it must be a unit vector up to rounding.
    template <class Real>
    static Light<Real> make(const LineSegment<float>& source) {
        const Vec3<Real> s = broadcast<Real>(source.s);
        return {broadcast<Real>(source.p0), std::is_same_v<Real, float> ? s : normalize(s), source.length};
    }
    /// Keeps the rounded direction: if the point is close to the line, a light turned by one rounding would be a
    /// different light.
    template <class Real>
    static Light<Exact> exact(const Light<Real>& rounded) {
        const Vec3<Exact> s = broadcast<Exact>(rounded.s);
        return {broadcast<Exact>(rounded.p0), std::is_same_v<Real, Exact> ? s : normalize(s), rounded.length};
    }
    static Exact miss(const Light<Exact>& light, const Vec3<Exact>& wi) {
        const Vec3<Exact> end = light.p0 + light.length * light.s;
        const Vec3<Exact> n = normalize(cross(light.p0, light.s));
        const Exact before = -dot(cross(n, normalize(light.p0)), wi);
        const Exact after = dot(cross(n, normalize(end)), wi);
        return std::max({std::fabs(dot(n, wi)), before, after});
    }
    template <class Uniform>
    static Random<float> random(Uniform uniform) {
        return uniform();
    }
    template <class Real>
    static Random<Real> widened(float u) {
        return u;
    }
    template <class Real>
    static Real first(Real u) {
        return u;
    }
};

/// Cylinders, with the same functions as PolygonInput.
struct CylinderInput : PairInput {
    using Class = CylinderClass;
    static constexpr int kVertexBound = 2;
    template <class Real>
    using Light = Cylinder<Real>;

    static bool fits_plain(const CylinderClass&) { return true; }

    template <class Real>
    static Light<Real> make(const Cylinder<float>& source) {
        return {LineInput::make<Real>(source.axis), source.radius};
    }
    template <class Real>
    static Light<Exact> exact(const Light<Real>& rounded) {
        return {LineInput::exact<Real>(rounded.axis), rounded.radius};
    }
    /// Angle by which a unit direction misses a light, 0 on it.
    static Exact miss(const Light<Exact>& light, const Vec3<Exact>& wi) {
        if (intersect(light, wi).hits) return 0;
        // Searches the point along the ray that is closest to the cylinder as seen from the origin. The quotient has
        // one minimum.
        Exact low = 0;
        Exact high = length(light.axis.p0) + light.axis.length + light.radius;
        const auto angle = [&](Exact t) { return distance_to(light, t * wi) / t; };
        for (int i = 0; i < 200; ++i) {
            const Exact left = low + (high - low) / 3;
            const Exact right = high - (high - low) / 3;
            const bool before_right = angle(left) < angle(right);
            Exact& end = before_right ? high : low;
            if (std::exchange(end, before_right ? right : left) == end) break;
        }
        return std::max(angle(high), Exact{0});
    }

    /// Direction of the axis towards the nearer cap. If it hits the cylinder, azimuths go all around it.
    static Vec3<Exact> along_axis(const Light<Exact>& light) {
        return dot(light.axis.p0, light.axis.s) > 0 ? light.axis.s : -light.axis.s;
    }

private:
    static Exact distance_to(const Light<Exact>& light, const Vec3<Exact>& p) {
        const Vec3<Exact> offset = p - light.axis.p0;
        const Exact along = dot(offset, light.axis.s);
        const Exact beyond = std::max(-along, along - light.axis.length);
        const Exact outwards = length(cross(offset, light.axis.s)) - light.radius;
        // Most points lie beside the cylinder or beyond a cap, not both, and hypot() is slow.
        if (beyond <= 0) return std::max(outwards, Exact{0});
        if (outwards <= 0) return beyond;
        return std::hypot(beyond, outwards);
    }
};

/// Spheres, disks, ellipses and ellipsoids, with the same functions as PolygonInput.
/// \tparam Shape one of them.
template <template <class> class Shape>
struct RoundInput : PairInput {
    using Class = RoundClass;
    using Kind = hostile::RoundKind<Shape>;
    static constexpr int kVertexBound = 2;
    template <class Real>
    using Light = Shape<Real>;

    static bool fits_plain(const RoundClass&) { return true; }

    template <class Real>
    static Light<Real> make(const Ellipsoid<float>& source) {
        const auto widened = [](const Vec3<float>& v) { return broadcast<Real>(v); };
        return Kind::from(
            Ellipsoid<Real>{widened(source.center),
                            {widened(source.axis[0]), widened(source.axis[1]), widened(source.axis[2])}});
    }
    template <class Real>
    static Light<Exact> exact(const Light<Real>& rounded) {
        return hostile::exact_light(rounded);
    }
    /// Angle by which a unit direction misses a light, 0 on it.
    static Exact miss(const Light<Exact>& light, const Vec3<Exact>& wi) {
        return hostile::round_miss(light, wi);
    }
};

/// Lights with lobes.
/// \tparam Input of the lights alone.
/// \tparam Kind  of the technique, in the registry.
template <class Input, class Kind>
struct OnLobeInput {
    using Class = OnLobes<typename Input::Class>;
    static constexpr int kVertexBound = Input::kVertexBound;
    template <class Real>
    using Light = typename Kind::template Light<Real>;
    template <class Real>
    using Random = typename Kind::template Random<Real>;

    static bool fits_plain(const Class&) { return true; }

    template <class Real, class Source>
    static Light<Real> make(const Source& source) {
        return {Input::template make<Real>(source.light), in_type<Real>(source.lobe)};
    }
    template <class Real>
    static Light<Exact> exact(const Light<Real>& light) {
        return {Input::template exact<Real>(light), in_type<Exact>(light.lobe)};
    }
    static Exact miss(const Light<Exact>& light, const Vec3<Exact>& wi) { return Input::miss(light, wi); }

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

private:
    /// Lobes have coefficients of float precision in every number type.
    template <class Real, class Source>
    static LtcCoefficients<Real> in_type(const LtcCoefficients<Source>& c) {
        const auto entry = [](Source x) { return static_cast<Real>(static_cast<float>(x)); };
        return {entry(c.m00), entry(c.m02), entry(c.m11), entry(c.m20), entry(c.m22), entry(c.albedo)};
    }
};

/// Rectangles that are made from polygons.
struct RectangleInput : PolygonInput<4> {
    template <class Real>
    static Light<Real> make(const PolygonLight& source) {
        return hostile::RectangleKind::from(PolygonInput<4>::make<Real>(source));
    }
};

namespace detail {

template <template <class> class Shape>
RoundInput<Shape> round_input_of(const hostile::AnyRoundKind<Shape>*) {
    return {};
}

template <class Kind>
auto input_of() {
    const auto geometry = [] {
        if constexpr (std::is_base_of_v<hostile::RectangleKind, Kind>)
            return RectangleInput();
        else if constexpr (hostile::kIsPolygon<Kind>)
            return PolygonInput<Kind::kVertices>();
        else if constexpr (hostile::kIsCylinder<Kind>)
            return CylinderInput();
        else if constexpr (hostile::kIsRound<Kind>)
            return round_input_of(static_cast<const Kind*>(nullptr));
        else
            return LineInput();
    };
    if constexpr (hostile::kHasLobe<Kind>)
        return OnLobeInput<decltype(geometry()), Kind>();
    else
        return geometry();
}

} // namespace detail

/// The input that a technique takes.
template <class Kind>
using InputOf = decltype(detail::input_of<Kind>());

} // namespace nusselt::proof
