#pragma once
/// The techniques whose accuracy is measured: each with its competitor and the reference that judges it.

#include "proof/accuracy/lights.h"
#include "proof/accuracy/row.h"

#include <nusselt/related/line_projected_solid_angle_peters.h>
#include <nusselt/related/polygon_projected_solid_angle_peters.h>
#include <nusselt/related/polygon_solid_angle_peters.h>
#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace nusselt::proof {

/// Polygons as techniques with a bound of N vertices take them.
template <int N>
struct PolygonInput {
    using Class = PolygonClass;
    static constexpr int kVertexBound = N;
    template <class Real>
    using Light = ConvexPolygon<Real, N>;
    template <class Real>
    using Random = Vec2<Real>;

    /// The transcriptions of the papers have no notion of unused slots for vertices.
    static bool fits_plain(const PolygonClass& lights) { return lights.vertex_count == N; }

    /// The light in a number type, as to_shading_space() makes it: positions follow from the edges.
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

/// Likewise for lines.
struct LineInput {
    using Class = LineClass;
    static constexpr int kVertexBound = 2;
    template <class Real>
    using Light = LineSegment<Real>;
    template <class Real>
    using Random = Real;

    static bool fits_plain(const LineClass&) { return true; }

    /// The direction has to be a unit vector up to rounding in each number type.
    template <class Real>
    static Light<Real> make(const LineSegment<float>& source) {
        const Vec3<Real> s = broadcast<Real>(source.s);
        return {broadcast<Real>(source.p0), std::is_same_v<Real, float> ? s : normalize(s), source.length};
    }
    /// Close to its line, a light turned by one rounding would be another light.
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

/// What a technique does not have.
struct Absent {};

/// What most techniques have in common.
struct CommonTraits {
    static constexpr bool kClips = true;           ///< to the horizon
    static constexpr bool kMeasuresVisible = true; ///< measure() is what the shading point sees
    static constexpr bool kCyclic = false;         ///< u = 0 and u = 1 coincide if the pole is in the light
    static constexpr bool kHasFloor = true;        ///< false if it is biased by design
    template <class Real>
    using Plain = Absent;    ///< transcription of the published formulas
    using TwoSteps = Absent; ///< as many steps as in float, without its rounding

    /// The unit direction around which the first random number turns.
    template <class Light>
    static Vec3<Exact> pole(const Light&) {
        return {0, 0, 1};
    }
};

template <int N>
struct PolygonProjectedSolidAngleTraits : CommonTraits, PolygonInput<N> {
    static constexpr const char* kName = "PolygonProjectedSolidAngle";
    static constexpr bool kCyclic = true;
    template <class Real>
    using Plain = PolygonProjectedSolidAnglePeters<Real, N>;
    template <class Real>
    using Ours = PolygonProjectedSolidAngle<Real, N>;
    using TwoSteps = PolygonProjectedSolidAngle<Exact, N, 2>;
    using Reference = PolygonProjectedSolidAngle<Exact, N, 6>;
};

template <int N>
struct PolygonProjectedSolidAngleBiasedTraits : PolygonProjectedSolidAngleTraits<N> {
    static constexpr const char* kName = "PolygonProjectedSolidAngleBiased";
    static constexpr bool kHasFloor = false;
    template <class Real>
    using Plain = Absent;
    template <class Real>
    using Ours = PolygonProjectedSolidAngleBiased<Real, N>;
    using TwoSteps = Absent;
};

template <int N>
struct PolygonSolidAngleTraits : CommonTraits, PolygonInput<N> {
    static constexpr const char* kName = "PolygonSolidAngle";
    static constexpr bool kClips = false;
    template <class Real>
    using Plain = PolygonSolidAnglePeters<Real, N>;
    template <class Real>
    using Ours = PolygonSolidAngle<Real, N>;
    using Reference = PolygonSolidAngle<Exact, N>;
};

template <int N>
struct PolygonClippedSolidAngleTraits : CommonTraits, PolygonInput<N> {
    static constexpr const char* kName = "PolygonClippedSolidAngle";
    template <class Real>
    using Ours = PolygonClippedSolidAngle<Real, N>;
    using Reference = PolygonClippedSolidAngle<Exact, N>;
};

template <int N>
struct PolygonAreaTraits : CommonTraits, PolygonInput<N> {
    static constexpr const char* kName = "PolygonArea";
    static constexpr bool kClips = false;
    static constexpr bool kMeasuresVisible = false;
    template <class Real>
    using Ours = PolygonArea<Real, N>;
    using Reference = PolygonArea<Exact, N>;
};

struct LineProjectedSolidAngleTraits : CommonTraits, LineInput {
    static constexpr const char* kName = "LineProjectedSolidAngle";
    template <class Real>
    using Plain = LineProjectedSolidAnglePeters<Real>;
    template <class Real>
    using Ours = LineProjectedSolidAngle<Real>;
    using TwoSteps = LineProjectedSolidAngle<Exact, 2>;
    using Reference = LineProjectedSolidAngle<Exact, 6>;
};

struct LineSolidAngleTraits : CommonTraits, LineInput {
    static constexpr const char* kName = "LineSolidAngle";
    static constexpr bool kClips = false;
    template <class Real>
    using Ours = LineSolidAngle<Real>;
    using Reference = LineSolidAngle<Exact>;
};

struct LineClippedSolidAngleTraits : CommonTraits, LineInput {
    static constexpr const char* kName = "LineClippedSolidAngle";
    template <class Real>
    using Ours = LineClippedSolidAngle<Real>;
    using Reference = LineClippedSolidAngle<Exact>;
};

struct LineAreaTraits : CommonTraits, LineInput {
    static constexpr const char* kName = "LineArea";
    static constexpr bool kClips = false;
    static constexpr bool kMeasuresVisible = false;
    template <class Real>
    using Ours = LineArea<Real>;
    using Reference = LineArea<Exact>;
};

} // namespace nusselt::proof
