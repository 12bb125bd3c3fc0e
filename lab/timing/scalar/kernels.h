#pragma once
/// The loops that the program times: each does one thing with a window of the lights.
///
/// The lights of a class are many more than a window, so that the predictor of branches cannot learn them, and a window
/// fits into the nearest cache, as a light does that is sampled right after it was prepared.

#include <optional>
#include <type_traits>

#include <nusselt/core/light_sample.h>

#include "lab/timing/scalar/lights.h"

namespace nusselt::lab {

inline constexpr int kLights = 8192;
inline constexpr int kWindow = 128;

/// Lights of one class, the shading points that see them, and random numbers.
template <class Light>
struct Lights {
    Light world[kLights], local[kLights];
    Vec3<float> point[kLights];
    Frame<float> frame[kLights];
    Vec2<float> u[kLights];
};

template <class Light>
struct LightTraits;

template <int N>
struct LightTraits<ConvexPolygon<float, N>> {
    static constexpr int kCorners = N;
    static ConvexPolygon<float, N> make(const Vec3<float>* corners) { return make_polygon<N>(corners, N); }
};

template <>
struct LightTraits<LineSegment<float>> {
    static constexpr int kCorners = 2;
    static LineSegment<float> make(const Vec3<float>* corners) { return make_line(corners[0], corners[1]); }
};

template <class Light>
inline Lights<Light> timed_lights;

/// Fills timed_lights, with the same lights in each run.
template <class Light>
void make_lights(const LightClass& light_class) {
    Lights<Light>& lights = timed_lights<Light>;
    constexpr int kCorners = LightTraits<Light>::kCorners;
    std::mt19937 generator(1);
    std::uniform_real_distribution<float> uniform(0.0f, 0.9999f);
    for (int i = 0; i < kLights; ++i) {
        const auto frame = Frame<double>::from_normal(random_normal(generator));
        const Vec3<double> point = 10.0 * random_normal(generator);
        const auto corners = random_light(light_class, kCorners, generator);
        Vec3<float> world[kCorners];
        for (int j = 0; j < kCorners; ++j)
            world[j] = broadcast<float>(point + frame.to_world(corners[static_cast<std::size_t>(j)]));
        lights.frame[i] = broadcast<float>(frame);
        lights.point[i] = broadcast<float>(point);
        lights.world[i] = LightTraits<Light>::make(world);
        lights.local[i] = to_shading_space(lights.world[i], lights.point[i], lights.frame[i]);
        lights.u[i] = {uniform(generator), uniform(generator)};
    }
}

/// What the published code does in place of to_shading_space(): it has no edges.
template <int N>
ConvexPolygon<float, N> corners_to_shading_space(const ConvexPolygon<float, N>& world,
                                                 const Vec3<float>& point, const Frame<float>& frame) {
    ConvexPolygon<float, N> local;
    for (int j = 0; j < N; ++j) local.vertex[j] = frame.to_local(world.vertex[j] - point);
    local.normal = frame.to_local(world.normal);
    return local;
}
inline LineSegment<float> corners_to_shading_space(const LineSegment<float>& world, const Vec3<float>& point,
                                                   const Frame<float>& frame) {
    return to_shading_space(world, point, frame);
}

/// Makes the compiler believe that an object is read completely.
template <class T>
void escape(const T& object) {
    asm volatile("" : : "r"(&object) : "memory");
}

/// The transforms of lights that techniques take.
struct WholeLight {
    template <class Light>
    static Light of(int i) {
        const Lights<Light>& lights = timed_lights<Light>;
        return to_shading_space(lights.world[i], lights.point[i], lights.frame[i]);
    }
};
struct CornersOnly {
    template <class Light>
    static Light of(int i) {
        const Lights<Light>& lights = timed_lights<Light>;
        return corners_to_shading_space(lights.world[i], lights.point[i], lights.frame[i]);
    }
};
/// For the baseline.
struct NoTransform {
    template <class Light>
    static const Light& of(int i) {
        return timed_lights<Light>.local[i];
    }
};

/// A technique of practically no cost.
template <class Light>
struct Baseline {
    Vec3<float> v;
    explicit Baseline(const ConvexPolygon<float, LightTraits<Light>::kCorners>& light) : v(light.vertex[0]) {}
    Vec3<float> direction(const Vec2<float>&) const { return v; }
    LightSample<float> sample(const Vec2<float>& u) const { return {v, u.x, v}; }
};
template <>
struct Baseline<LineSegment<float>> {
    Vec3<float> v;
    explicit Baseline(const LineSegment<float>& light) : v(light.p0) {}
    Vec3<float> direction(const float&) const { return v; }
    LightSample<float> sample(const float& u) const { return {v, u, v}; }
};

/// Whether a technique returns directions alone.
template <class Technique, class = void>
inline constexpr bool kHasDirection = false;
template <class Technique>
inline constexpr bool kHasDirection<Technique, std::void_t<decltype(&Technique::direction)>> = true;

/// The direction of a sample; techniques for lines take one number.
template <class Technique>
Vec3<float> direction(const Technique& technique, const Vec2<float>& u) {
    if constexpr (std::is_invocable_v<decltype(&Technique::direction), const Technique&, const float&>)
        return technique.direction(u.x);
    else
        return technique.direction(u);
}

/// Functions that do one thing with some lights, kWindow at most.
struct Loops {
    void (*transform)(int first, int count);          ///< lights to shading space
    void (*prepare)(int first, int count);            ///< constructs techniques for lights in shading space
    void (*prepare_from_world)(int first, int count); ///< transforms, then constructs
    void (*keep)(int first, int count);               ///< constructs what sample() and direction() use
    void (*sample)(int first_number, int count);      ///< a sample of each, with density and point
    void (*direction)(int first_number, int count);   ///< a direction of each; null if the technique has none
    void (*one_sample)(int first, int count);         ///< constructs and takes one sample
};

/// \tparam Technique e.g. PolygonSolidAngle<float, 4>
/// \tparam Transform WholeLight, CornersOnly or NoTransform.
template <class Technique, class Light, class Transform>
struct LoopsOf {
    static inline std::optional<Technique> kept[kWindow];

    static void transform(int first, int count) {
        for (int i = first; i < first + count; ++i) escape(Transform::template of<Light>(i));
    }
    static void prepare(int first, int count) {
        for (int i = first; i < first + count; ++i) escape(Technique(timed_lights<Light>.local[i]));
    }
    static void prepare_from_world(int first, int count) {
        for (int i = first; i < first + count; ++i) escape(Technique(Transform::template of<Light>(i)));
    }
    static void keep(int first, int count) {
        for (int i = 0; i < count; ++i) kept[i].emplace(timed_lights<Light>.local[first + i]);
    }
    static void sample(int first_number, int count) {
        for (int i = 0; i < count; ++i) escape(draw(*kept[i], timed_lights<Light>.u[first_number + i]));
    }
    static void direction(int first_number, int count) {
        if constexpr (kHasDirection<Technique>)
            for (int i = 0; i < count; ++i)
                escape(lab::direction(*kept[i], timed_lights<Light>.u[first_number + i]));
    }
    static void one_sample(int first, int count) {
        for (int i = first; i < first + count; ++i)
            escape(draw(Technique(timed_lights<Light>.local[i]), timed_lights<Light>.u[i]));
    }

    static constexpr Loops loops() {
        return {transform, prepare, prepare_from_world,
                keep,      sample,  kHasDirection<Technique> ? direction : nullptr,
                one_sample};
    }
};

/// A row of the table.
struct Row {
    const char* technique;
    LightClass lights;
    int vertices; ///< 2 for lines
    void (*make_lights)(const LightClass&);
    Loops baseline, ours, published;
};

/// \tparam Ours, Published techniques for lights of type Light.
template <class Light, class Ours, class Published>
constexpr Row row(const char* technique, const LightClass& lights) {
    return {technique,
            lights,
            LightTraits<Light>::kCorners,
            make_lights<Light>,
            LoopsOf<Baseline<Light>, Light, NoTransform>::loops(),
            LoopsOf<Ours, Light, WholeLight>::loops(),
            LoopsOf<Published, Light, CornersOnly>::loops()};
}

} // namespace nusselt::lab
