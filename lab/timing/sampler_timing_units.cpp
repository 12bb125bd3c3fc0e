/// Compiled once per instruction set; see sampler_timing_kernel.h.

#include <nusselt/simd/pack.h>

#include <optional>
#include <vector>

#include "lab/timing/sampler_timing_kernel.h"
#include "proof/techniques/registry.h"

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

/// The technique for one light, the same in all lanes.
template <template <class> class Technique, class Real, class Light>
Technique<Real> of_one_light(const Light& light) {
    const Technique<float> single(light);
    if constexpr (RealTraits<Real>::kLanes == 1) {
        return single;
    } else {
        return Technique<Real>(single);
    }
}

/// The lights and random numbers of a run in the type that a technique takes.
template <class Kind>
struct Input {
    static constexpr bool kIsPolygon = hostile::kIsPolygon<Kind>;
    static constexpr bool kIsCylinder = hostile::kIsCylinder<Kind>;
    static constexpr bool kHasLobe = hostile::kHasLobe<Kind>;
    static constexpr LightKind kKind =
        kIsPolygon    ? (kHasLobe ? LightKind::polygon_on_lobe : LightKind::polygon)
        : kIsCylinder ? (kHasLobe ? LightKind::cylinder_on_lobe : LightKind::cylinder)
                      : (kHasLobe ? LightKind::line_on_lobe : LightKind::line);
    static constexpr int kVertexBound = [] {
        if constexpr (kIsPolygon) return Kind::kVertices;
        return 2;
    }();
    template <class Real>
    using Light = typename Kind::template Light<Real>;
    template <class Real>
    using Random = typename Kind::template Random<Real>;

    template <class Real>
    static Light<Real> light(const TimedLights& lights, int i) {
        if constexpr (kHasLobe) {
            const auto entry = [&](int k) { return column<Real>(lights.lobe[k], i); };
            return {geometry<Real>(lights, i), {entry(0), entry(1), entry(2), entry(3), entry(4), entry(5)}};
        } else {
            return Kind::from(geometry<Real>(lights, i));
        }
    }
    template <class Real>
    static Random<Real> random(const TimedLights& lights, int i) {
        if constexpr (hostile::kTakesPairs<Kind>)
            return {column<Real>(lights.u[0], i), column<Real>(lights.u[1], i)};
        else
            return column<Real>(lights.u[0], i);
    }

private:
    template <class Real>
    static auto geometry(const TimedLights& lights, int i) {
        if constexpr (kIsPolygon) {
            Vec3<Real> vertices[kVertexBound];
            for (int j = 0; j < kVertexBound; ++j) vertices[j] = vertex<Real>(lights, i, j);
            return make_polygon<kVertexBound>(vertices, kVertexBound);
        } else {
            const auto line = make_line(vertex<Real>(lights, i, 0), vertex<Real>(lights, i, 1));
            if constexpr (kIsCylinder)
                return Cylinder<Real>{line, column<Real>(lights.radius, i)};
            else
                return line;
        }
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

/// A technique of practically no cost, whose loops the compiler cannot remove.
template <class Real>
struct Baseline {
    Vec3<Real> v;
    template <int N>
    explicit Baseline(const ConvexPolygon<Real, N>& light) : v(light.vertex[0] + light.normal) {}
    explicit Baseline(const LineSegment<Real>& light) : v(light.p0 + light.s) {}
    explicit Baseline(const Cylinder<Real>& light) : v(light.axis.p0 + light.axis.s) {}
    template <class Single>
    explicit Baseline(const Baseline<Single>& single) : v(broadcast<Real>(single.v)) {}
    LightSample<Real> sample(const Real& u) const { return {v, u, v}; }
    LightSample<Real> sample(const Vec2<Real>& u) const { return {v, u.x + u.y, v}; }
};

/// Makes the compiler believe that an object is read completely.
template <class T>
void escape(const T& object) {
    asm volatile("" : : "r"(&object) : "memory");
}

/// Memory for the techniques of all groups of lights, which prepare() fills.
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

using Native = Pack<float, kNativeLanes<float>>;
using Pair = Pack<float, 2 * kNativeLanes<float>>;

/// Adds a technique as scalar code, with a light per lane of one register, and with two registers in flight.
template <template <class> class Technique, class Input>
void add(std::vector<TimedTechnique>& techniques, const char* name) {
    techniques.push_back(timed<Technique, Input, float>(name));
    techniques.push_back(timed<Technique, Input, Native>(name));
    techniques.push_back(timed<Technique, Input, Pair>(name));
}

/// The name of the suite in techniques.json.
struct TimingSuite {
    static constexpr std::string_view kName = "timing";
};

/// Adds the baseline and then the techniques of a list, each after the formulas that it replaces.
template <class First, class... Rest>
void add_all(hostile::KindList<First, Rest...> list, std::vector<TimedTechnique>& techniques) {
    add<Baseline, Input<First>>(techniques, "Baseline");
    list.for_each([&]<class Kind> {
        using Published = typename Kind::template Published<float>;
        if constexpr (!std::is_same_v<Published, hostile::Absent>)
            techniques.push_back(timed<Kind::template Published, Input<Kind>, float>(Kind::kPublishedName));
        add<Kind::template Technique, Input<Kind>>(techniques, Kind::kName);
    });
}

/// All techniques that are timed.
inline std::vector<TimedTechnique> techniques() {
    using namespace hostile;
    std::vector<TimedTechnique> result;
    // A baseline belongs to the type of light that techniques take, so rectangles share that of polygons.
    add_all(TestedBy<TimingSuite, PolygonKinds<4>, RectangleKinds>(), result);
    add_all(TestedBy<TimingSuite, PolygonKinds<8>>(), result);
    add_all(TestedBy<TimingSuite, PolygonOnLobeKinds<4>>(), result);
    add_all(TestedBy<TimingSuite, LineKinds>(), result);
    add_all(TestedBy<TimingSuite, LineOnLobeKinds>(), result);
    add_all(TestedBy<TimingSuite, CylinderKinds>(), result);
    add_all(TestedBy<TimingSuite, CylinderOnLobeKinds>(), result);
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
