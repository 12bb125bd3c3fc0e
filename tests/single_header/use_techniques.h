#pragma once
/// Prints the bits of everything that the techniques return. The file that includes this one has included the library.

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
    use<PolygonArea<Real, 4>>("PolygonArea", polygon, u);
    use<PolygonSolidAngle<Real, 4>>("PolygonSolidAngle", polygon, u);
    use<PolygonClippedSolidAngle<Real, 4>>("PolygonClippedSolidAngle", polygon, u);
    use<PolygonProjectedSolidAngle<Real, 4>>("PolygonProjectedSolidAngle", polygon, u);
    use<PolygonProjectedSolidAngleBiased<Real, 4>>("PolygonProjectedSolidAngleBiased", polygon, u);
    use<LineArea<Real>>("LineArea", line, u.x);
    use<LineSolidAngle<Real>>("LineSolidAngle", line, u.x);
    use<LineClippedSolidAngle<Real>>("LineClippedSolidAngle", line, u.x);
    use<LineProjectedSolidAngle<Real>>("LineProjectedSolidAngle", line, u.x);
    const Cylinder<Real> cylinder{line, Real(0.25f)};
    use<CylinderSolidAngle<Real>>("CylinderSolidAngle", cylinder, u);
    use<CylinderProjectedSolidAngle<Real>>("CylinderProjectedSolidAngle", cylinder, u);
}

} // namespace use_techniques
