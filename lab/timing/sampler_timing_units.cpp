/// Compiled once per instruction set; see sampler_timing_kernel.h.

#include <nusselt/simd/pack.h>

#include <optional>
#include <vector>

#include "lab/timing/sampler_timing_kernel.h"
#include "proof/techniques/registry.h"

NUSSELT_NAMESPACE_BEGIN
namespace timing {

using lab::kLargestVertexCount;
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
Vec3<Real> vector(const float (&columns)[3][kTimedLights], int light) {
    return {column<Real>(columns[0], light), column<Real>(columns[1], light),
            column<Real>(columns[2], light)};
}

template <class Real>
Real sum(const Vec3<Real>& v) {
    return v.x + v.y + v.z;
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
            return {geometry<Real>(lights.coordinates, lights, i),
                    {entry(0), entry(1), entry(2), entry(3), entry(4), entry(5)}};
        } else {
            return Kind::from(geometry<Real>(lights.coordinates, lights, i));
        }
    }
    /// The light in world space, for those without a lobe.
    template <class Real>
    static Light<Real> world(const TimedLights& lights, int i) {
        return geometry<Real>(lights.world, lights, i);
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
    static auto geometry(const float (&corners)[kLargestVertexCount][3][kTimedLights],
                         const TimedLights& lights, int i) {
        if constexpr (kIsPolygon) {
            Vec3<Real> vertices[kVertexBound];
            for (int j = 0; j < kVertexBound; ++j) vertices[j] = vector<Real>(corners[j], i);
            return make_polygon<kVertexBound>(vertices, kVertexBound);
        } else {
            const auto line = make_line(vector<Real>(corners[0], i), vector<Real>(corners[1], i));
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
    static inline typename Input::template Random<Real> random[kGroups];

    static void load(const TimedLights& lights) {
        for (int i = 0; i < kGroups; ++i) {
            light[i] = Input::template light<Real>(lights, i * kLanes);
            random[i] = Input::template random<Real>(lights, i * kLanes);
        }
    }
};

/// The same lights in world space, and where they are seen from.
template <class Input, class Real>
struct LoadedWorld {
    static constexpr int kLanes = RealTraits<Real>::kLanes;
    static constexpr int kGroups = kTimedLights / kLanes;
    static inline typename Input::template Light<Real> light[kGroups];
    static inline Vec3<Real> point[kGroups];
    static inline Frame<Real> frame[kGroups];

    static void load(const TimedLights& lights) {
        for (int i = 0; i < kGroups; ++i) {
            light[i] = Input::template world<Real>(lights, i * kLanes);
            point[i] = vector<Real>(lights.point, i * kLanes);
            frame[i] = Frame<Real>::from_normal(vector<Real>(lights.normal, i * kLanes));
        }
    }
};

/// How lights get to shading space. The published formulas take no edges.
struct WholeLight {
    template <class Light, class Real>
    static Light transform(const Light& world, const Vec3<Real>& point, const Frame<Real>& frame) {
        return to_shading_space(world, point, frame);
    }
};
struct CornersOnly : WholeLight {
    using WholeLight::transform;
    template <class Real, int N>
    static ConvexPolygon<Real, N> transform(const ConvexPolygon<Real, N>& world, const Vec3<Real>& point,
                                            const Frame<Real>& frame) {
        ConvexPolygon<Real, N> local;
        for (int j = 0; j < N; ++j) local.vertex[j] = frame.to_local(world.vertex[j] - point);
        local.normal = frame.to_local(world.normal);
        return local;
    }
};
/// Of the baseline, which takes light from shading space.
struct NoTransform {
    template <class Light, class Real>
    static const Light& transform(const Light& world, const Vec3<Real>&, const Frame<Real>&) {
        return world;
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
    Vec3<Real> direction(const Real&) const { return v; }
    Vec3<Real> direction(const Vec2<Real>&) const { return v; }
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

/// The functions of TimedTechnique.
template <template <class> class Technique, class Input, class Real>
void load(const TimedLights& lights) {
    using Data = Loaded<Input, Real>;
    Data::load(lights);
    for (int i = 0; i < Data::kGroups; ++i)
        Prepared<Technique, Input, Real>::technique[i].emplace(Data::light[i]);
}

template <template <class> class Technique, class Input, class Real>
void load_with_world(const TimedLights& lights) {
    load<Technique, Input, Real>(lights);
    LoadedWorld<Input, Real>::load(lights);
}

template <template <class> class Technique, class Input, class Real>
float prepare() {
    using Data = Loaded<Input, Real>;
    for (int i = 0; i < Data::kGroups; ++i) escape(Technique<Real>(Data::light[i]));
    return 0;
}

template <template <class> class Technique, class Input, class Real, class Transform>
float prepare_from_world() {
    using Data = LoadedWorld<Input, Real>;
    for (int i = 0; i < Data::kGroups; ++i)
        escape(Technique<Real>(Transform::transform(Data::light[i], Data::point[i], Data::frame[i])));
    return 0;
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
float direction() {
    using Data = Loaded<Input, Real>;
    Real total = Real(0);
    for (int i = 0; i < Data::kGroups; ++i)
        total = total + sum((*Prepared<Technique, Input, Real>::technique[i]).direction(Data::random[i]));
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
            nullptr,
            sample<Technique, Input, Real>,
            nullptr};
}

/// Adds how long it takes from world space on.
template <template <class> class Technique, class Input, class Real, class Transform>
constexpr TimedTechnique timed_from_world(const char* name) {
    TimedTechnique result = timed<Technique, Input, Real>(name);
    result.load = load_with_world<Technique, Input, Real>;
    result.prepare_from_world = prepare_from_world<Technique, Input, Real, Transform>;
    return result;
}

/// For techniques that have direction().
template <template <class> class Technique, class Input, class Real, class Transform>
constexpr TimedTechnique timed_with_direction(const char* name) {
    TimedTechnique result = timed_from_world<Technique, Input, Real, Transform>(name);
    result.direction = direction<Technique, Input, Real>;
    return result;
}

template <class Kind>
inline constexpr bool kHasPublished =
    !std::is_same_v<typename Kind::template Published<float>, hostile::Absent>;

using Native = Pack<float, kNativeLanes<float>>;
using Pair = Pack<float, 2 * kNativeLanes<float>>;

/// The name of the suite in techniques.json.
struct TimingSuite {
    static constexpr std::string_view kName = "timing";
};

/// Adds a technique with published formulas after these.
template <class Kind, class Real>
void add_compared(std::vector<TimedTechnique>& techniques) {
    techniques.push_back(
        timed_with_direction<Kind::template Published, Input<Kind>, Real, CornersOnly>(Kind::kPublishedName));
    techniques.push_back(
        timed_from_world<Kind::template Technique, Input<Kind>, Real, WholeLight>(Kind::kName));
}

/// Adds the baseline and the techniques of a list that have published formulas.
template <class Real, class First, class... Rest>
void add_compared_of(hostile::KindList<First, Rest...> list, std::vector<TimedTechnique>& techniques) {
    techniques.push_back(timed_with_direction<Baseline, Input<First>, Real, NoTransform>("Baseline"));
    list.for_each([&]<class Kind> {
        if constexpr (kHasPublished<Kind>) add_compared<Kind, Real>(techniques);
    });
}

/// Adds the techniques of a list that have none. Without any that have some, the baseline, too.
template <class Real, class First, class... Rest>
void add_others_of(hostile::KindList<First, Rest...> list, std::vector<TimedTechnique>& techniques) {
    if constexpr (!(kHasPublished<First> || ... || kHasPublished<Rest>))
        techniques.push_back(timed<Baseline, Input<First>, Real>("Baseline"));
    list.for_each([&]<class Kind> {
        if constexpr (!kHasPublished<Kind>)
            techniques.push_back(timed<Kind::template Technique, Input<Kind>, Real>(Kind::kName));
    });
}

/// All techniques that are timed. Those with published formulas also with two registers in flight, and for each number of
/// vertices.
inline std::vector<TimedTechnique> techniques() {
    using namespace hostile;
    // A baseline belongs to the type of light that techniques take, so rectangles share that of polygons.
    using Polygons = TestedBy<TimingSuite, PolygonKinds<4>, RectangleKinds>;
    using Lines = TestedBy<TimingSuite, LineKinds>;
    std::vector<TimedTechnique> result;
    const auto add_all = [&]<class Real> {
        add_compared_of<Real>(Polygons(), result);
        add_others_of<Real>(Polygons(), result);
        add_compared_of<Real>(Lines(), result);
        add_others_of<Real>(Lines(), result);
        add_others_of<Real>(TestedBy<TimingSuite, PolygonOnLobeKinds<4>>(), result);
        add_others_of<Real>(TestedBy<TimingSuite, LineOnLobeKinds>(), result);
        add_others_of<Real>(TestedBy<TimingSuite, CylinderKinds>(), result);
        add_others_of<Real>(TestedBy<TimingSuite, CylinderOnLobeKinds>(), result);
    };
    add_all.template operator()<float>();
    add_all.template operator()<Native>();
    add_compared_of<Pair>(Polygons(), result);
    add_compared_of<Pair>(Lines(), result);
    add_compared_of<Native>(TestedBy<TimingSuite, PolygonKinds<3>>(), result);
    add_compared_of<Native>(TestedBy<TimingSuite, PolygonKinds<5>>(), result);
    add_compared_of<Native>(TestedBy<TimingSuite, PolygonKinds<6>>(), result);
    add_compared_of<Native>(TestedBy<TimingSuite, PolygonKinds<7>>(), result);
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
