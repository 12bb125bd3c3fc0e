/// Compiled once per instruction set; see sampler_timing_kernel.h.

#include <nusselt/related/line_projected_solid_angle_peters.h>
#include <nusselt/related/polygon_projected_solid_angle_peters.h>
#include <nusselt/related/polygon_solid_angle_peters.h>
#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>
#include <nusselt/sampling/polygon_area.h>
#include <nusselt/sampling/polygon_projected_solid_angle.h>
#include <nusselt/sampling/polygon_solid_angle.h>
#include <nusselt/simd/pack.h>

#include <optional>
#include <vector>

#include "lab/timing/sampler_timing_kernel.h"

NUSSELT_NAMESPACE_BEGIN
namespace timing {

using lab::kTimedLights;
using lab::LightKind;
using lab::TimedLights;
using lab::TimedTechnique;

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
Real sum(const LightSample<Real>& s) {
    return s.wi.x + s.wi.y + s.wi.z + s.pdf + s.p.x + s.p.y + s.p.z;
}

template <class Real>
float lane_sum(const Real& x) {
    if constexpr (RealTraits<Real>::kLanes == 1) {
        return x;
    } else {
        float result = 0;
        for (int i = 0; i < RealTraits<Real>::kLanes; ++i) result += x.lane(i);
        return result;
    }
}

/// The technique for one light, in all lanes.
template <template <class> class Technique, class Real, class Light>
Technique<Real> of_one_light(const Light& light) {
    const Technique<float> single(light);
    if constexpr (RealTraits<Real>::kLanes == 1) {
        return single;
    } else {
        return Technique<Real>(single);
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

/// Makes the compiler believe that somebody reads all of an object.
template <class T>
void escape(const T& object) {
    asm volatile("" : : "r"(&object) : "memory");
}

/// Memory for a technique of each group; filled by prepare().
template <template <class> class Technique, class Input, class Real>
struct Prepared {
    using Data = Loaded<Input, Real>;
    static inline std::optional<Technique<Real>> technique[Data::kGroups];
};

template <template <class> class Technique, class Input, class Real>
float prepare() {
    using Data = Loaded<Input, Real>;
    for (int i = 0; i < Data::kGroups; ++i) {
        const Technique<Real> technique(Data::light[i]);
        escape(technique);
    }
    return 0;
}

template <template <class> class Technique, class Input, class Real>
void load(const TimedLights& lights) {
    using Data = Loaded<Input, Real>;
    Data::load(lights);
    for (int i = 0; i < Data::kGroups; ++i)
        Prepared<Technique, Input, Real>::technique[i].emplace(Data::light[i]);
}

template <template <class> class Technique, class Input, class Real>
float sample() {
    using Data = Loaded<Input, Real>;
    Real total = Real(0);
    for (int i = 0; i < Data::kGroups; ++i)
        total = total + sum((*Prepared<Technique, Input, Real>::technique[i]).sample(Data::random[i]));
    return lane_sum(total);
}

template <template <class> class Technique, class Input, class Real>
float sample_one() {
    using Data = Loaded<Input, Real>;
    const auto technique = of_one_light<Technique, Real>(Data::first);
    escape(technique);
    Real total = Real(0);
    for (int i = 0; i < Data::kGroups; ++i) total = total + sum(technique.sample(Data::random[i]));
    return lane_sum(total);
}

template <template <class> class Technique, class Input, class Real>
constexpr TimedTechnique timed(const char* name) {
    return {name,
            Input::kKind,
            RealTraits<Real>::kLanes,
            Input::kVertexBound,
            load<Technique, Input, Real>,
            prepare<Technique, Input, Real>,
            sample<Technique, Input, Real>,
            sample_one<Technique, Input, Real>};
}

template <int N>
struct Polygons {
    template <class Real>
    using Area = PolygonArea<Real, N>;
    template <class Real>
    using SolidAngle = PolygonSolidAngle<Real, N>;
    template <class Real>
    using SolidAnglePlain = PolygonSolidAnglePeters<Real, N>;
    template <class Real>
    using ClippedSolidAngle = PolygonClippedSolidAngle<Real, N>;
    template <class Real>
    using ProjectedSolidAngle = PolygonProjectedSolidAngle<Real, N>;
    template <class Real>
    using ProjectedSolidAnglePlain = PolygonProjectedSolidAnglePeters<Real, N>;
    template <class Real>
    using Biased = PolygonProjectedSolidAngleBiased<Real, N>;
};
template <class Real>
using LineProjected = LineProjectedSolidAngle<Real>;
template <class Real>
using LineProjectedPlain = LineProjectedSolidAnglePeters<Real>;

using Native = Pack<float, kNativeLanes<float>>;
using Pair = Pack<float, 2 * kNativeLanes<float>>;

/// A technique as scalar code, with a light per lane of a register, and with two registers in flight.
template <template <class> class Technique, class Input>
void add(std::vector<TimedTechnique>& techniques, const char* name) {
    techniques.push_back(timed<Technique, Input, float>(name));
    techniques.push_back(timed<Technique, Input, Native>(name));
    techniques.push_back(timed<Technique, Input, Pair>(name));
}

template <int N>
void add_polygons(std::vector<TimedTechnique>& techniques) {
    using Input = PolygonInput<N>;
    add<Baseline, Input>(techniques, "Baseline");
    add<Polygons<N>::template Area, Input>(techniques, "PolygonArea");
    techniques.push_back(
        timed<Polygons<N>::template SolidAnglePlain, Input, float>("PolygonSolidAnglePeters"));
    add<Polygons<N>::template SolidAngle, Input>(techniques, "PolygonSolidAngle");
    add<Polygons<N>::template ClippedSolidAngle, Input>(techniques, "PolygonClippedSolidAngle");
    techniques.push_back(timed<Polygons<N>::template ProjectedSolidAnglePlain, Input, float>(
        "PolygonProjectedSolidAnglePeters"));
    add<Polygons<N>::template ProjectedSolidAngle, Input>(techniques, "PolygonProjectedSolidAngle");
    add<Polygons<N>::template Biased, Input>(techniques, "PolygonProjectedSolidAngleBiased");
}

/// Everything that is timed.
inline std::vector<TimedTechnique> techniques() {
    std::vector<TimedTechnique> result;
    add_polygons<4>(result);
    add_polygons<8>(result);
    add<Baseline, LineInput>(result, "Baseline");
    add<LineArea, LineInput>(result, "LineArea");
    add<LineSolidAngle, LineInput>(result, "LineSolidAngle");
    add<LineClippedSolidAngle, LineInput>(result, "LineClippedSolidAngle");
    result.push_back(timed<LineProjectedPlain, LineInput, float>("LineProjectedSolidAnglePeters"));
    add<LineProjected, LineInput>(result, "LineProjectedSolidAngle");
    return result;
}

} // namespace timing
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

template <>
std::vector<TimedTechnique> timed_techniques<base::Isa::NUSSELT_UNIT_ISA>() {
    return timing::techniques();
}

} // namespace nusselt::lab
