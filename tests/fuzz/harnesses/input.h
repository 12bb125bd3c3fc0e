#pragma once
/// Converts the bytes of libFuzzer to legal lights, and crashes with a description of the light.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <string_view>

#include "proof/hostile/contract.h"

namespace nusselt::fuzz {

/// The name of the suite in techniques.json.
struct FuzzSuite {
    static constexpr std::string_view kName = "fuzz";
};

/// Reads numbers from the bytes; zeros once they are used up.
class Input {
public:
    Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

    std::uint8_t byte() { return take<std::uint8_t>(); }

    /// Any number of at most 2^50 [m], including denormal ones.
    template <class T>
    T coordinate() {
        const T x = take<T>();
        return std::fabs(x) <= T(0x1p50) ? x : T(0);
    }
    template <class T>
    Vec3<T> vector() {
        const T x = coordinate<T>();
        const T y = coordinate<T>();
        return {x, y, coordinate<T>()};
    }
    /// In [0, 1).
    template <class T>
    T random_number() {
        const T x = std::fabs(take<T>());
        return x < 1 ? x : std::isfinite(x) ? x - std::floor(x) : T(0);
    }

private:
    template <class T>
    T take() {
        T x{};
        if (sizeof(T) <= size_) {
            std::memcpy(&x, data_, sizeof(T));
            data_ += sizeof(T);
            size_ -= sizeof(T);
        } else {
            size_ = 0;
        }
        return x;
    }

    const std::uint8_t* data_;
    std::size_t size_;
};

/// An affine image of a convex polygon, planar up to rounding.
/// \tparam N 4 or more.
template <int N, class T>
ConvexPolygon<T, N> polygon(Input& input) {
    struct Shape {
        int count;
        double vertex[5][2];
    };
    static constexpr Shape kShapes[] = {
        {3, {{0, 0}, {1, 0}, {0, 1}}},
        {4, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
        {4, {{0, 0}, {1, 0}, {0.5, 1}, {0, 1}}},
        {4, {{0, 0}, {0, 0}, {1, 0}, {0, 1}}},
        {4, {{0, 0}, {0.5, 0}, {1, 0}, {0, 1}}},
        {4, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}},
        {5, {{0, 0}, {1, 0}, {1.5, 0.5}, {1, 1}, {0, 1}}},
    };
    // The last one has too many vertices for quadrilaterals.
    constexpr int kShapeCount = N < 5 ? 6 : 7;
    const Shape& shape = kShapes[input.byte() % kShapeCount];
    const auto origin = broadcast<double>(input.vector<T>());
    const auto a = broadcast<double>(input.vector<T>());
    const auto b = broadcast<double>(input.vector<T>());
    Vec3<T> vertices[N] = {};
    for (int j = 0; j < shape.count; ++j) {
        const auto [x, y] = shape.vertex[j];
        vertices[j] = broadcast<T>(origin + x * a + y * b);
    }
    return make_polygon<N>(vertices, shape.count);
}

template <class T>
LineSegment<T> line(Input& input) {
    const Vec3<T> begin = input.vector<T>();
    return make_line(begin, input.vector<T>());
}

/// A lobe that leans by any angle, of any width in each direction and skewed in its plane.
template <class T>
LtcCoefficients<T> lobe(Input& input) {
    constexpr double kQuarterTurn = 1.5707963267948966;
    const double tilt = kQuarterTurn * static_cast<double>(input.random_number<T>());
    const double width = std::exp2(-12 * static_cast<double>(input.random_number<T>()));
    const double aspect = std::exp2(4 * static_cast<double>(input.random_number<T>()) - 3);
    const double skew = static_cast<double>(input.random_number<T>()) - 0.5;
    const double sine = std::sin(tilt);
    const double cosine = std::cos(tilt);
    return {
        static_cast<T>(cosine + skew * sine), static_cast<T>(sine - skew * cosine), static_cast<T>(aspect),
        static_cast<T>(-width * sine),        static_cast<T>(width * cosine),       T(1)};
}

template <class T>
void print(const Vec3<T>& v) {
    std::fprintf(stderr, "  {%a, %a, %a}\n", static_cast<double>(v.x), static_cast<double>(v.y),
                 static_cast<double>(v.z));
}
template <class T, int N>
void print(const ConvexPolygon<T, N>& light) {
    for (const Vec3<T>& v : light.vertex) print(v);
}
template <class T>
void print(const LineSegment<T>& light) {
    print(light.p0);
    print(light.s);
    std::fprintf(stderr, "  %a\n", static_cast<double>(light.length));
}

template <class T>
void print(const LtcCoefficients<T>& lobe) {
    for (const T x : {lobe.m00, lobe.m02, lobe.m11, lobe.m20, lobe.m22})
        std::fprintf(stderr, "  %a\n", static_cast<double>(x));
}
template <class T, int N>
void print(const hostile::PolygonOnLobe<T, N>& light) {
    const ConvexPolygon<T, N>& polygon = light;
    print(polygon);
    print(light.lobe);
}
template <class T>
void print(const hostile::LineOnLobe<T>& light) {
    const LineSegment<T>& line = light;
    print(line);
    print(light.lobe);
}
template <class T>
void print(const Cylinder<T>& light) {
    print(light.axis);
    std::fprintf(stderr, "  radius %a\n", static_cast<double>(light.radius));
}
template <class T>
void print(const hostile::CylinderOnLobe<T>& light) {
    const Cylinder<T>& cylinder = light;
    print(cylinder);
    print(light.lobe);
}

template <class Light>
void fail_if(bool broken, const char* name, const char* problem, const Light& light) {
    if (!broken) return;
    std::fprintf(stderr, "%s: %s\n", name, problem);
    print(light);
    std::abort();
}

/// Runs one technique.
template <class Kind, class T>
void check(const typename Kind::template Light<T>& light, const typename Kind::template Random<T>& u) {
    const char* problem = hostile::violation<Kind, T>(light, hostile::outputs_of<Kind, T>(light, u));
    fail_if(problem != nullptr, Kind::kName, problem, light);
}

/// Runs check.operator()<T>(input) in float or double; the first byte decides.
template <class Check>
void check_in_float_or_double(const std::uint8_t* data, std::size_t size, const Check& check) {
    Input input(data, size);
    if (input.byte() % 2 == 0)
        check.template operator()<float>(input);
    else
        check.template operator()<double>(input);
}

} // namespace nusselt::fuzz
