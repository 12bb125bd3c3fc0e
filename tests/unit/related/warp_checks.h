#pragma once
/// Lights and checks for techniques that warp the random numbers of others. Each check computes an error, so that mutants
/// show that it can fail.

#include <nusselt/geometry/polygon_measures.h>
#include <nusselt/related/line_warp_hart.h>
#include <nusselt/related/polygon_warp_hart.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nusselt::warp_test {

using Corners = std::vector<Vec3<double>>;

/// Lights above the horizon, on it and through it, with the zenith inside and outside; some leave slots unused.
inline std::vector<Corners> polygons() {
    return {
        {{-1, -0.7, 1}, {1.2, -0.8, 1}, {1.1, 0.9, 1}, {-0.9, 1, 1}},
        {{0.5, 0.2, 1}, {1.5, 0.3, 1}, {1.4, 1.2, 1}, {0.4, 1, 1}},
        {{0.4, 1, 1}, {1.4, 1.2, 1}, {1.5, 0.3, 1}, {0.5, 0.2, 1}},
        {{0.3, -1, 0.5}, {1.5, -0.2, 0.7}, {0.6, 1, 1.2}},
        {{1, -1, 0}, {1, 1, 0}, {1, 1, 1.5}, {1, -1, 1.5}},
        {{1, -1, -0.5}, {1, 1, -0.5}, {1, 1, 1}, {1, -1, 1}},
        {{1, 1, 1}, {1, -1, 1}, {1, -1, -0.5}, {1, 1, -0.5}},
        {{0.5, -0.25, 1}, {1.5, 0.25, -0.25}, {1.5, 0.625, 0.3125}, {0.75, 0.25, 1.25}},
        {{2, 0.5, -3}, {1, 0, -1}, {0.5, 0.5, 1}, {1.5, 1, -1}},
        {{1, 0.5, 2}, {1.02, 0.5, 2}, {1.02, 0.53, 2}, {1, 0.53, 2}},
    };
}

/// Lines above the horizon, on it and through it.
inline std::vector<Corners> lines() {
    return {{{-1, 0.5, 1}, {1, 0.5, 1}},       {{0.5, -0.4, 0.7}, {1.5, 0.8, 2}},
            {{1, 0.3, 0}, {0.4, -0.5, 1}},     {{1, 0.3, -0.5}, {0.4, -0.5, 1}},
            {{0.4, -0.5, 1}, {1, 0.3, -0.5}},  {{0.5, 0.2, 0.1}, {0.5, 0.2, 2}},
            {{1, 0.5, 2}, {1.01, 0.52, 2.01}}, {{-50, 0.2, 0.5}, {70, 0.3, 0.6}}};
}

template <class Real>
Vec3<Real> as(const Vec3<double>& v) {
    return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

/// A technique for polygons as a type, with its base.
template <template <class, int> class TechniqueType, template <class, int> class BaseType, int N>
struct OfPolygon {
    static constexpr bool kIsLine = false;
    template <class Real>
    using Light = ConvexPolygon<Real, N>;
    template <class Real>
    using Technique = TechniqueType<Real, N>;
    template <class Real>
    using Base = BaseType<Real, N>;
    template <class Real>
    using Random = Vec2<Real>;
    template <class Real>
    static Light<Real> make(const Corners& corners) {
        std::vector<Vec3<Real>> v;
        for (const auto& corner : corners) v.push_back(as<Real>(corner));
        return make_polygon<N>(v.data(), static_cast<int>(v.size()));
    }
    static std::vector<Corners> lights() { return polygons(); }
    static constexpr int kRandomCorners = N;
};

/// A technique for lines as a type, with its base.
template <template <class> class TechniqueType, template <class> class BaseType>
struct OfLine {
    static constexpr bool kIsLine = true;
    template <class Real>
    using Light = LineSegment<Real>;
    template <class Real>
    using Technique = TechniqueType<Real>;
    template <class Real>
    using Base = BaseType<Real>;
    template <class Real>
    using Random = Real;
    template <class Real>
    static Light<Real> make(const Corners& ends) {
        return make_line(as<Real>(ends[0]), as<Real>(ends[1]));
    }
    static std::vector<Corners> lights() { return lines(); }
    static constexpr int kRandomCorners = 2;
};

template <class Kind, class Real>
auto random_numbers(Real x, Real y) {
    if constexpr (Kind::kIsLine)
        return x;
    else
        return Vec2<Real>{x, y};
}

/// Calls visit(u) for the midpoints of a grid over the unit interval or square.
template <class Kind, class Real, class Visit>
void for_each_midpoint(int count, const Visit& visit) {
    const auto at = [&](int i) { return (static_cast<Real>(i) + Real(0.5)) / static_cast<Real>(count); };
    for (int j = 0; j < (Kind::kIsLine ? 1 : count); ++j)
        for (int i = 0; i < count; ++i) visit(random_numbers<Kind, Real>(at(i), at(j)));
}

inline double largest_difference(float a, float b) { return std::fabs(static_cast<double>(a) - b); }
inline double largest_difference(double a, double b) { return std::fabs(a - b); }
inline double largest_difference(long double a, long double b) {
    return static_cast<double>(std::fabs(a - b));
}
template <class T>
double largest_difference(const Vec2<T>& a, const Vec2<T>& b) {
    return std::max(largest_difference(a.x, b.x), largest_difference(a.y, b.y));
}

/// How far the mean density over the light is from 1, by samples of the base.
template <class Kind, template <class> class Technique = Kind::template Technique>
double normalisation_error(const Corners& corners, int count) {
    const auto light = Kind::template make<double>(corners);
    const typename Kind::template Base<double> base(light);
    const Technique<double> technique(light);
    double sum = 0, weight = 0;
    for_each_midpoint<Kind, double>(count, [&](const auto& u) {
        const auto s = base.sample(u);
        sum += technique.pdf(s.wi) / s.pdf;
        weight += 1;
    });
    return std::fabs(sum / weight - 1);
}

/// Mean and relative standard deviation of the estimate of the projected solid angle.
struct Moments {
    double mean, deviation;
};
template <class Technique, class Kind>
Moments moments(const Corners& corners, int count) {
    const Technique technique(Kind::template make<double>(corners));
    double sum = 0, squares = 0, weight = 0;
    for_each_midpoint<Kind, double>(count, [&](const auto& u) {
        const auto s = technique.sample(u);
        const double estimate = s.pdf > 0 ? std::max(s.wi.z, 0.0) / s.pdf : 0;
        sum += estimate;
        squares += estimate * estimate;
        weight += 1;
    });
    const double mean = sum / weight;
    return {mean, std::sqrt(std::max(squares / weight - mean * mean, 0.0)) / mean};
}

/// Relative error of the estimate of the projected solid angle.
template <class Kind, template <class> class Technique = Kind::template Technique>
double estimation_error(const Corners& corners, int count) {
    const double expected = projected_solid_angle(Kind::template make<double>(corners));
    return std::fabs(moments<Technique<double>, Kind>(corners, count).mean / expected - 1);
}

/// How much a step of random numbers moves the direction in solid angle, or the point of a line in solid angle per radius,
/// times the density, minus 1.
template <class Kind, template <class> class Technique = Kind::template Technique>
double jacobian_error(const Corners& corners) {
    using Real = long double;
    constexpr Real kStep = 1e-6L;
    const auto light = Kind::template make<Real>(corners);
    const Technique<Real> technique(light);
    double worst = 0;
    for_each_midpoint<Kind, Real>(7, [&](const auto& u) {
        const auto s = technique.sample(u);
        Real measure;
        if constexpr (Kind::kIsLine) {
            const auto moved = technique.sample(u + kStep).p - technique.sample(u - kStep).p;
            measure = 2 * length(cross(s.wi, light.s)) * length(moved) / dot(s.p, s.p) / (2 * kStep);
        } else {
            const auto moved = [&](const Vec2<Real>& by) {
                return technique.sample(u + by).wi - technique.sample(u - by).wi;
            };
            measure = length(cross(moved({kStep, 0}), moved({0, kStep}))) / (4 * kStep * kStep);
        }
        worst = std::max(worst, static_cast<double>(std::fabs(measure * s.pdf - 1)));
    });
    return worst;
}

/// The largest difference between random numbers and the inverse of their sample.
template <class Kind, class Real, template <class> class Technique = Kind::template Technique>
double inversion_error(const Corners& corners) {
    const Technique<Real> technique(Kind::template make<Real>(corners));
    double worst = 0;
    for_each_midpoint<Kind, Real>(13, [&](const auto& u) {
        worst = std::max(worst, largest_difference(technique.invert(technique.sample(u).wi), u));
    });
    return worst;
}

/// The largest relative difference between the density of a sample and pdf().
template <class Kind, class Real, template <class> class Technique = Kind::template Technique>
double pdf_error(const Corners& corners) {
    const Technique<Real> technique(Kind::template make<Real>(corners));
    double worst = 0;
    for_each_midpoint<Kind, Real>(13, [&](const auto& u) {
        const auto s = technique.sample(u);
        worst = std::max(worst, static_cast<double>(std::fabs(technique.pdf(s.wi) / s.pdf - 1)));
    });
    return worst;
}

} // namespace nusselt::warp_test
