#pragma once
/// What the units compiled per instruction set share; see sampler_timing_kernel.h.

#include <nusselt/simd/pack.h>

#include <new>
#include <type_traits>

#include "lab/timing/sampler_timing_kernel.h"
#include "proof/techniques/registry.h"

NUSSELT_NAMESPACE_BEGIN
namespace timing {

using lab::kLargestVertexCount;
using lab::kTimedLights;
using lab::LightKind;
using lab::TimedLights;
using lab::TimedLightType;
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

using Corners = float[kLargestVertexCount][3][kTimedLights];

/// How lights are read from columns. \tparam Base the class from which the kinds of techniques for such lights derive.
template <class Base>
struct Source;

template <int N>
struct Source<hostile::PolygonKind<N>> {
    static constexpr LightKind kKind = LightKind::polygon;
    static constexpr int kVertexBound = N;
    template <class Real>
    static ConvexPolygon<Real, N> light(const Corners& corners, const TimedLights&, int i) {
        Vec3<Real> vertices[N];
        for (int j = 0; j < N; ++j) vertices[j] = vector<Real>(corners[j], i);
        return make_polygon<N>(vertices, N);
    }
};
template <>
struct Source<hostile::RectangleKind> : Source<hostile::PolygonKind<4>> {
    template <class Real>
    static ConvexPolygon<Real, 4> light(const Corners& corners, const TimedLights& lights, int i) {
        return hostile::RectangleKind::from(Source<hostile::PolygonKind<4>>::light<Real>(corners, lights, i));
    }
};
template <>
struct Source<hostile::LineKind> {
    static constexpr LightKind kKind = LightKind::line;
    static constexpr int kVertexBound = 2;
    template <class Real>
    static LineSegment<Real> light(const Corners& corners, const TimedLights&, int i) {
        return make_line(vector<Real>(corners[0], i), vector<Real>(corners[1], i));
    }
};
template <>
struct Source<hostile::CylinderKind> {
    static constexpr LightKind kKind = LightKind::cylinder;
    static constexpr int kVertexBound = 2;
    template <class Real>
    static Cylinder<Real> light(const Corners& corners, const TimedLights& lights, int i) {
        return {Source<hostile::LineKind>::light<Real>(corners, lights, i), column<Real>(lights.radius, i)};
    }
};
template <template <class> class Shape>
struct Source<hostile::RoundKind<Shape>> {
    static constexpr LightKind kKind = LightKind::round;
    static constexpr int kVertexBound = 4;
    template <class Real>
    static Shape<Real> light(const Corners& corners, const TimedLights&, int i) {
        const Vec3<Real> a = vector<Real>(corners[0], i), b = vector<Real>(corners[1], i),
                         c = vector<Real>(corners[2], i), d = vector<Real>(corners[3], i);
        const Vec3<Real> u = Real(0.5f) * (a - c), v = Real(0.5f) * (b - d);
        const Vec3<Real> across = (Real(1) / length(u)) * cross(u, v);
        return hostile::RoundKind<Shape>::from(Ellipsoid<Real>{Real(0.5f) * (a + c), {u, v, across}});
    }
};
/// The same with a lobe.
template <class Base, class Bare, LightKind Kind>
struct SourceOnLobe : Source<Bare> {
    static constexpr LightKind kKind = Kind;
    template <class Real>
    static typename Base::template Light<Real> light(const Corners& corners, const TimedLights& lights,
                                                     int i) {
        const auto entry = [&](int k) { return column<Real>(lights.lobe[k], i); };
        return {Source<Bare>::template light<Real>(corners, lights, i),
                {entry(0), entry(1), entry(2), entry(3), entry(4), entry(5)}};
    }
};
template <int N>
struct Source<hostile::PolygonOnLobeKind<N>>
    : SourceOnLobe<hostile::PolygonOnLobeKind<N>, hostile::PolygonKind<N>, LightKind::polygon_on_lobe> {};
template <>
struct Source<hostile::LineOnLobeKind>
    : SourceOnLobe<hostile::LineOnLobeKind, hostile::LineKind, LightKind::line_on_lobe> {};
template <>
struct Source<hostile::CylinderOnLobeKind>
    : SourceOnLobe<hostile::CylinderOnLobeKind, hostile::CylinderKind, LightKind::cylinder_on_lobe> {};

template <template <class> class Shape>
struct Source<hostile::RoundOnLobeKind<Shape>>
    : SourceOnLobe<hostile::RoundOnLobeKind<Shape>, hostile::RoundKind<Shape>, LightKind::round_on_lobe> {};

/// A light in world space, and where it is seen from.
template <class Light, class Real>
struct Place {
    Light light;
    Vec3<Real> point;
    Frame<Real> frame;
};

template <class Base, class Real>
struct LightType {
    static constexpr int kLanes = RealTraits<Real>::kLanes;
    using Light = typename Base::template Light<Real>;
    using Random = typename Base::template Random<Real>;

    static void load(const TimedLights& lights, void* memory) {
        for (int i = 0; i < kTimedLights; i += kLanes)
            static_cast<Light*>(memory)[i / kLanes] =
                Source<Base>::template light<Real>(lights.coordinates, lights, i);
    }
    static void load_random(const TimedLights& lights, void* memory) {
        for (int i = 0; i < kTimedLights; i += kLanes) {
            Random& random = static_cast<Random*>(memory)[i / kLanes];
            if constexpr (std::is_same_v<Random, Real>)
                random = column<Real>(lights.u[0], i);
            else
                random = {column<Real>(lights.u[0], i), column<Real>(lights.u[1], i)};
        }
    }
    static void load_places(const TimedLights& lights, void* memory) {
        for (int i = 0; i < kTimedLights; i += kLanes)
            static_cast<Place<Light, Real>*>(memory)[i / kLanes] = {
                Source<Base>::template light<Real>(lights.world, lights, i), vector<Real>(lights.point, i),
                Frame<Real>::from_normal(vector<Real>(lights.normal, i))};
    }

    static constexpr bool kHasPlaces = !has_lobe(Source<Base>::kKind);
    static constexpr TimedLightType kType = [] {
        TimedLightType type{sizeof(Light), 0, sizeof(Random), load, load_random, nullptr};
        if constexpr (kHasPlaces) {
            type.place_size = sizeof(Place<Light, Real>);
            type.load_places = load_places;
        }
        return type;
    }();
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
/// Of the baseline, which takes no light from world space.
struct NoTransform {
    template <class Light, class Real>
    static const Light& transform(const Light& world, const Vec3<Real>&, const Frame<Real>&) {
        return world;
    }
};

template <class Base, class Real, class Transform>
void transform(const void* memory, void* light) {
    using Light = typename Base::template Light<Real>;
    const auto& place = *static_cast<const Place<Light, Real>*>(memory);
    *static_cast<Light*>(light) = Transform::transform(place.light, place.point, place.frame);
}

/// A technique of practically no cost.
template <class Real>
struct Baseline {
    Vec3<Real> v;
    template <int N>
    explicit Baseline(const ConvexPolygon<Real, N>& light) : v(light.vertex[0] + light.normal) {}
    explicit Baseline(const LineSegment<Real>& light) : v(light.p0 + light.s) {}
    explicit Baseline(const Cylinder<Real>& light) : v(light.axis.p0 + light.axis.s) {}
    explicit Baseline(const Sphere<Real>& light) : v(light.center) {}
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

template <class Technique, class Light>
void prepare(const void* light, void* technique) {
    new (technique) Technique(*static_cast<const Light*>(light));
}

template <class Technique, class Random>
void sample(const void* technique, const void* random, int count) {
    const auto& t = *static_cast<const Technique*>(technique);
    for (int i = 0; i < count; ++i) escape(t.sample(static_cast<const Random*>(random)[i]));
}

template <class Technique, class Random>
void direction(const void* technique, const void* random, int count) {
    const auto& t = *static_cast<const Technique*>(technique);
    for (int i = 0; i < count; ++i) escape(t.direction(static_cast<const Random*>(random)[i]));
}

template <class Technique, class Base, class Real>
constexpr TimedTechnique timed(const char* name) {
    using Type = LightType<Base, Real>;
    return {name,
            Source<Base>::kKind,
            RealTraits<Real>::kLanes,
            Source<Base>::kVertexBound,
            &Type::kType,
            sizeof(Technique),
            prepare<Technique, typename Type::Light>,
            sample<Technique, typename Type::Random>,
            nullptr,
            nullptr};
}

/// Adds how long it takes from world space on.
template <class Technique, class Base, class Real, class Transform>
constexpr TimedTechnique timed_from_world(const char* name) {
    TimedTechnique result = timed<Technique, Base, Real>(name);
    result.transform = transform<Base, Real, Transform>;
    return result;
}

/// Also for directions alone.
template <class Technique, class Base, class Real, class Transform>
constexpr TimedTechnique timed_with_direction(const char* name) {
    TimedTechnique result = timed_from_world<Technique, Base, Real, Transform>(name);
    result.direction = direction<Technique, typename LightType<Base, Real>::Random>;
    return result;
}

/// The class that says which light a kind of technique takes.
template <int N>
hostile::PolygonKind<N> base_of(const hostile::PolygonKind<N>*);
template <int N>
hostile::PolygonOnLobeKind<N> base_of(const hostile::PolygonOnLobeKind<N>*);
hostile::RectangleKind base_of(const hostile::RectangleKind*);
hostile::LineKind base_of(const hostile::LineKind*);
hostile::LineOnLobeKind base_of(const hostile::LineOnLobeKind*);
hostile::CylinderKind base_of(const hostile::CylinderKind*);
hostile::CylinderOnLobeKind base_of(const hostile::CylinderOnLobeKind*);
template <template <class> class Shape>
hostile::RoundKind<Shape> base_of(const hostile::RoundKind<Shape>*);
template <template <class> class Shape>
hostile::RoundOnLobeKind<Shape> base_of(const hostile::RoundOnLobeKind<Shape>*);
template <class Kind>
using BaseOf = decltype(base_of(static_cast<const Kind*>(nullptr)));

template <class Kind>
inline constexpr bool kHasPublished =
    !std::is_same_v<typename Kind::template Published<float>, hostile::Absent>;

/// Rows in memory that needs no allocation.
struct Rows {
    static constexpr int kMost = 256;
    TimedTechnique row[kMost] = {};
    int count = 0;
    constexpr void add(const TimedTechnique& technique) { row[count++] = technique; }
};

template <class Base, class Real>
constexpr void add_baseline(Rows& rows) {
    if constexpr (LightType<Base, Real>::kHasPlaces)
        rows.add(timed_with_direction<Baseline<Real>, Base, Real, NoTransform>("Baseline"));
    else
        rows.add(timed<Baseline<Real>, Base, Real>("Baseline"));
}

/// Adds a technique, after the published formulas if there are some.
template <class Kind, class Real>
constexpr void add(Rows& rows) {
    using Base = BaseOf<Kind>;
    using Ours = typename Kind::template Technique<Real>;
    if constexpr (kHasPublished<Kind>) {
        rows.add(timed_with_direction<typename Kind::template Published<Real>, Base, Real, CornersOnly>(
            Kind::kPublishedName));
        rows.add(timed_from_world<Ours, Base, Real, WholeLight>(Kind::kName));
    } else {
        rows.add(timed<Ours, Base, Real>(Kind::kName));
    }
}

/// Adds the baseline and the techniques of a list, whose lights are of the same kind.
template <class Real, class First, class... Rest>
constexpr void add_all(hostile::KindList<First, Rest...>, Rows& rows) {
    add_baseline<BaseOf<First>, Real>(rows);
    add<First, Real>(rows);
    (add<Rest, Real>(rows), ...);
}

/// The same for those that have published formulas.
template <class Real, class First, class... Rest>
constexpr void add_compared(hostile::KindList<First, Rest...> list, Rows& rows) {
    add_baseline<BaseOf<First>, Real>(rows);
    list.for_each([&]<class Kind> {
        if constexpr (kHasPublished<Kind>) add<Kind, Real>(rows);
    });
}

using Native = Pack<float, kNativeLanes<float>>;
using Pair = Pack<float, 2 * kNativeLanes<float>>;

/// The name of the suite in techniques.json.
struct TimingSuite {
    static constexpr std::string_view kName = "timing";
};

/// Techniques for quadrilaterals.
using Polygons = hostile::TestedBy<TimingSuite, hostile::PolygonKinds<4>>;

} // namespace timing
NUSSELT_NAMESPACE_END
