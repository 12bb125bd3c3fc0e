#pragma once
/// The contract of a technique, to be checked for any light and random number: never fails.

#include <cmath>
#include <cstdio>
#include <string>

#include <nusselt/simd/pack.h>

#include "hostile.h"
#include "techniques.h"

namespace nusselt_test {

using NativeFloat = nusselt::Pack<float, nusselt::kNativeLanes<float>>;
using NativeDouble = nusselt::Pack<double, nusselt::kNativeLanes<double>>;

inline bool finite(long double x) { return std::isfinite(x); }
template <class T>
bool finite(const nusselt::Vec2<T>& v) {
    return finite(v.x) && finite(v.y);
}
template <class T>
bool finite(const nusselt::Vec3<T>& v) {
    return finite(v.x) && finite(v.y) && finite(v.z);
}

template <class T>
bool in_unit_interval(T u) {
    return u >= 0 && u < 1;
}
template <class T>
bool in_unit_interval(const nusselt::Vec2<T>& u) {
    return in_unit_interval(u.x) && in_unit_interval(u.y);
}

/// Axis-aligned box of a light, and the distance of its farthest corner.
struct Bounds {
    nusselt::Vec3<long double> low, high;
    long double extent;

    template <class T, int N>
    explicit Bounds(const nusselt::ConvexPolygon<T, N>& polygon) {
        low = high = nusselt::broadcast<long double>(polygon.vertex[0]);
        for (const auto& v : polygon.vertex) include(nusselt::broadcast<long double>(v));
        finish();
    }
    template <class T>
    explicit Bounds(const nusselt::LineSegment<T>& line) {
        low = high = nusselt::broadcast<long double>(line.p0);
        include(low + static_cast<long double>(line.length) * nusselt::broadcast<long double>(line.s));
        finish();
    }

    /// Whether a point is in the box, up to a tolerance relative to the extent.
    template <class T>
    bool contain(const nusselt::Vec3<T>& p, long double tolerance) const {
        // Where numbers are denormal, rounding is absolute.
        const long double slack = tolerance * extent + 16 * std::numeric_limits<T>::min();
        return p.x >= low.x - slack && p.x <= high.x + slack && p.y >= low.y - slack &&
               p.y <= high.y + slack && p.z >= low.z - slack && p.z <= high.z + slack;
    }

private:
    void include(const nusselt::Vec3<long double>& v) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    void finish() {
        const nusselt::Vec3<long double> far{std::max(-low.x, high.x), std::max(-low.y, high.y),
                                             std::max(-low.z, high.z)};
        extent = std::max(far.x, std::max(far.y, far.z));
    }
};

/// All numbers of a light, random number or sample in hexadecimal, to be pasted into a regression test.
template <class T, class Struct>
std::string hexadecimal(const Struct& numbers) {
    std::string text;
    for (std::size_t i = 0; i < sizeof(Struct) / sizeof(T); ++i) {
        T x;
        std::memcpy(&x, reinterpret_cast<const unsigned char*>(&numbers) + i * sizeof(T), sizeof(T));
        char buffer[64];
        std::snprintf(buffer, sizeof buffer, "%La ", static_cast<long double>(x));
        text += buffer;
    }
    return text;
}

/// Everything that a technique returns for one light and random number.
template <class T, class Random>
struct Outputs {
    nusselt::LightSample<T> sample;
    T pdf;
    Random inverse;
    T measure;
};

/// What is wrong with the outputs; empty if nothing is.
template <class T, class Random>
std::string violation(const Outputs<T, Random>& out, const Bounds& bounds) {
    // Rounding of a unit vector, and of a hit point relative to the farthest point of the light: 1e-5 in float, which is
    // far below what an image shows, and enough for sums of up to nine weighted vertices.
    constexpr long double kTolerance = 84 * std::numeric_limits<T>::epsilon();
    const auto& [wi, pdf, p] = out.sample;
    if (!finite(wi) || !finite(p) || !finite(pdf)) return "sample is not finite";
    if (!finite(out.pdf) || out.pdf < 0 || pdf < 0) return "pdf is not finite or negative";
    if (!finite(out.measure) || out.measure < 0) return "measure is not finite or negative";
    if (!in_unit_interval(out.inverse)) return "invert leaves [0, 1)";
    if (pdf == 0) return "";
    if (!(out.measure > 0)) return "pdf without measure";
    const auto w = nusselt::broadcast<long double>(wi);
    if (std::fabs(dot(w, w) - 1) > kTolerance) return "wi is not a unit vector";
    if (!bounds.contain(p, kTolerance)) return "p is off the light";
    return "";
}

template <class Kind, class T>
auto hostile_light(HostileLights<T>& lights) {
    if constexpr (kIsPolygon<Kind>) {
        return lights.template polygon<Kind::kVertices>();
    } else {
        return lights.line();
    }
}

template <class Kind, class T>
auto hostile_random(HostileLights<T>& lights) {
    if constexpr (kIsPolygon<Kind>) {
        const T x = lights.random_number();
        return nusselt::Vec2<T>{x, lights.random_number()};
    } else {
        return lights.random_number();
    }
}

} // namespace nusselt_test
