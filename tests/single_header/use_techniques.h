#pragma once
/// Prints the bits of everything that the techniques return. The file that includes this one has included the library.
/// The build writes all_techniques.h, with a line for each technique of the registry.

#include <cstdio>

namespace use_techniques {

inline void print(float x) { std::printf(" %a", static_cast<double>(x)); }
inline void print(double x) { std::printf(" %a", x); }
template <class T, int N>
void print(const nusselt::Pack<T, N>& x) {
    for (int i = 0; i < N; ++i) print(x.lane(i));
}
template <class Real>
void print(const nusselt::Vec2<Real>& v) {
    print(v.x);
    print(v.y);
}
template <class Real>
void print(const nusselt::Vec3<Real>& v) {
    print(v.x);
    print(v.y);
    print(v.z);
}

template <class Technique, class Light, class Random>
void use(const char* name, const Light& light, const Random& u) {
    const Technique technique(light);
    const auto sample = technique.sample(u);
    std::printf("%s", name);
    print(sample.wi);
    print(sample.pdf);
    print(sample.p);
    print(technique.pdf(sample.wi));
    print(technique.invert(sample.wi));
    print(technique.measure());
    std::printf("\n");
}

/// A technique for LTCs with a glossy lobe.
template <class Technique, class Real>
struct OnLobe : Technique {
    template <class Light>
    explicit OnLobe(const Light& light)
        : Technique(light, nusselt::Ltc<Real>(
                               {Real(1), Real(0.25f), Real(0.875f), Real(0), Real(0.375f), Real(1)})) {}
};

/// Every technique on a light that is clipped at the horizon, in one number type.
template <class Real>
void use_all(int seed) {
    using namespace nusselt;
    const auto number = [&](int i) { return Real(nusselt::scalar_t<Real>((seed * 37 + i * 11) % 64) / 64); };
    const Vec3<Real> corners[] = {{Real(1), number(1), Real(-1)},
                                  {Real(2), number(2), Real(0.5f)},
                                  {Real(0.5f) + number(3), Real(1.5f) + number(4), Real(2)}};
    const auto polygon = make_polygon<4>(corners, 3);
    const auto line = make_line(corners[0], corners[2]);
    const Vec2<Real> u{number(5), number(6)};
    const Cylinder<Real> cylinder{line, Real(0.25f)};
    const Sphere<Real> sphere{corners[0], Real(0.5f)};
    const Disk<Real> disk{corners[1], {Real(0), Real(1), Real(0)}, Real(0.5f)};
    const Ellipse<Real> ellipse{
        corners[1], {Real(0.5f), Real(0), Real(0)}, {Real(0), Real(0.25f), Real(0.5f)}};
    const Ellipsoid<Real> ellipsoid{corners[2],
                                    {{Real(0.5f), Real(0), Real(0)},
                                     {Real(0), Real(0.25f), Real(0)},
                                     {Real(0), Real(0.25f), Real(0.75f)}}};
#include "all_techniques.h"
}

} // namespace use_techniques
