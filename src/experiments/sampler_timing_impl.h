#pragma once
/// Compiled once per instruction set; see sampler_timing_kernel.h.

#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>
#include <nusselt/simd/pack.h>

#include "experiments/sampler_timing_kernel.h"

NUSSELT_NAMESPACE_BEGIN
namespace timing {

using experiments::kTimedLights;
using experiments::LightKind;
using experiments::TimedLights;
using experiments::TimedTechnique;

template <class Real>
Real column(const float* values, int light) {
    if constexpr (RealTraits<Real>::kLanes == 1) {
        return values[light];
    } else {
        return Real::load(values + light);
    }
}

template <class Real>
Vec3<Real> vertex(const TimedLights& lights, int light, int j) {
    const auto& v = lights.coordinates[j];
    return {column<Real>(v[0], light), column<Real>(v[1], light), column<Real>(v[2], light)};
}

template <class Real>
float sum(const LightSample<Real>& s) {
    const Real all = s.wi.x + s.wi.y + s.wi.z + s.pdf + s.p.x + s.p.y + s.p.z;
    if constexpr (RealTraits<Real>::kLanes == 1) {
        return all;
    } else {
        float result = 0;
        for (int i = 0; i < RealTraits<Real>::kLanes; ++i) result += all.lane(i);
        return result;
    }
}

/// The lights and random numbers of a run in the type that the technique takes.
template <int N>
struct PolygonInput {
    static constexpr LightKind kKind = LightKind::polygon;
    static constexpr int kVertexBound = N;
    template <class Real>
    using Light = ConvexPolygon<Real, N>;
    template <class Real>
    using Random = Vec2<Real>;
    template <class Real>
    static Light<Real> light(const TimedLights& lights, int i) {
        Vec3<Real> vertices[N];
        for (int j = 0; j < N; ++j) vertices[j] = vertex<Real>(lights, i, j);
        return make_polygon<N>(vertices, N);
    }
    template <class Real>
    static Random<Real> random(const TimedLights& lights, int i) {
        return {column<Real>(lights.u[0], i), column<Real>(lights.u[1], i)};
    }
};
struct LineInput {
    static constexpr LightKind kKind = LightKind::line;
    static constexpr int kVertexBound = 2;
    template <class Real>
    using Light = LineSegment<Real>;
    template <class Real>
    using Random = Real;
    template <class Real>
    static Light<Real> light(const TimedLights& lights, int i) {
        return make_line(vertex<Real>(lights, i, 0), vertex<Real>(lights, i, 1));
    }
    template <class Real>
    static Random<Real> random(const TimedLights& lights, int i) {
        return column<Real>(lights.u[0], i);
    }
};

template <class Input, class Real>
struct Loaded {
    static constexpr int kLanes = RealTraits<Real>::kLanes;
    static constexpr int kGroups = kTimedLights / kLanes;
    static inline typename Input::template Light<Real> light[kGroups];
    static inline typename Input::template Light<float> first;
    static inline typename Input::template Random<Real> random[kGroups];

    static void load(const TimedLights& lights) {
        for (int i = 0; i < kGroups; ++i) {
            light[i] = Input::template light<Real>(lights, i * kLanes);
            random[i] = Input::template random<Real>(lights, i * kLanes);
        }
        first = Input::template light<float>(lights, 0);
    }
};

/// A technique of practically no cost that keeps the loops alive.
template <class Real>
struct Baseline {
    Vec3<Real> v;
    template <int N>
    explicit Baseline(const ConvexPolygon<Real, N>& light) : v(light.vertex[0] + light.normal) {}
    explicit Baseline(const LineSegment<Real>& light) : v(light.p0 + light.s) {}
    template <class Single>
    explicit Baseline(const Baseline<Single>& single) : v(broadcast<Real>(single.v)) {}
    LightSample<Real> sample(const Real& u) const { return {v, u, v}; }
    LightSample<Real> sample(const Vec2<Real>& u) const { return {v, u.x + u.y, v}; }
};

template <template <class> class Technique, class Input, class Real>
float prepare() {
    using Data = Loaded<Input, Real>;
    float total = 0;
    for (int i = 0; i < Data::kGroups; ++i)
        total += sum(Technique<Real>(Data::light[i]).sample(Data::random[i]));
    return total;
}

template <template <class> class Technique, class Input, class Real>
float sample() {
    using Data = Loaded<Input, Real>;
    const Technique<Real> technique{Technique<float>(Data::first)};
    float total = 0;
    for (int i = 0; i < Data::kGroups; ++i) total += sum(technique.sample(Data::random[i]));
    return total;
}

template <template <class> class Technique, class Input, class Real>
constexpr TimedTechnique timed(const char* name) {
    return {name,
            Input::kKind,
            RealTraits<Real>::kLanes,
            Input::kVertexBound,
            Loaded<Input, Real>::load,
            prepare<Technique, Input, Real>,
            sample<Technique, Input, Real>};
}

template <int N>
struct Polygons {
    template <class Real>
    using Area = PolygonArea<Real, N>;
    template <class Real>
    using SolidAngle = PolygonSolidAngle<Real, N>;
    template <class Real>
    using ClippedSolidAngle = PolygonClippedSolidAngle<Real, N>;
    template <class Real>
    using ProjectedSolidAngle = PolygonProjectedSolidAngle<Real, N>;
    template <class Real>
    using Biased = PolygonProjectedSolidAngleBiased<Real, N>;
};
template <class Real>
using LineProjected = LineProjectedSolidAngle<Real>;

using Native = Pack<float, kNativeLanes<float>>;

inline constexpr TimedTechnique kTechniques[] = {
    timed<Baseline, PolygonInput<4>, float>("Baseline"),
    timed<Baseline, PolygonInput<4>, Native>("Baseline"),
    timed<Baseline, PolygonInput<8>, float>("Baseline"),
    timed<Baseline, PolygonInput<8>, Native>("Baseline"),
    timed<Baseline, LineInput, float>("Baseline"),
    timed<Baseline, LineInput, Native>("Baseline"),
    timed<Polygons<4>::Area, PolygonInput<4>, float>("PolygonArea"),
    timed<Polygons<4>::Area, PolygonInput<4>, Native>("PolygonArea"),
    timed<Polygons<4>::SolidAngle, PolygonInput<4>, float>("PolygonSolidAngle"),
    timed<Polygons<4>::SolidAngle, PolygonInput<4>, Native>("PolygonSolidAngle"),
    timed<Polygons<4>::ClippedSolidAngle, PolygonInput<4>, float>("PolygonClippedSolidAngle"),
    timed<Polygons<4>::ClippedSolidAngle, PolygonInput<4>, Native>("PolygonClippedSolidAngle"),
    timed<Polygons<4>::ProjectedSolidAngle, PolygonInput<4>, float>("PolygonProjectedSolidAngle"),
    timed<Polygons<4>::ProjectedSolidAngle, PolygonInput<4>, Native>("PolygonProjectedSolidAngle"),
    timed<Polygons<8>::ProjectedSolidAngle, PolygonInput<8>, float>("PolygonProjectedSolidAngle"),
    timed<Polygons<8>::ProjectedSolidAngle, PolygonInput<8>, Native>("PolygonProjectedSolidAngle"),
    timed<Polygons<4>::Biased, PolygonInput<4>, float>("PolygonProjectedSolidAngleBiased"),
    timed<Polygons<4>::Biased, PolygonInput<4>, Native>("PolygonProjectedSolidAngleBiased"),
    timed<LineArea, LineInput, float>("LineArea"),
    timed<LineArea, LineInput, Native>("LineArea"),
    timed<LineSolidAngle, LineInput, float>("LineSolidAngle"),
    timed<LineSolidAngle, LineInput, Native>("LineSolidAngle"),
    timed<LineClippedSolidAngle, LineInput, float>("LineClippedSolidAngle"),
    timed<LineClippedSolidAngle, LineInput, Native>("LineClippedSolidAngle"),
    timed<LineProjected, LineInput, float>("LineProjectedSolidAngle"),
    timed<LineProjected, LineInput, Native>("LineProjectedSolidAngle"),
};

} // namespace timing
NUSSELT_NAMESPACE_END
