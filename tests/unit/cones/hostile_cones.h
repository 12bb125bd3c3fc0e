#pragma once
/// Spheres, disks, ellipses and ellipsoids that break samplers, and the rules that techniques keep on them.

#include <cmath>
#include <random>
#include <string>

#include <nusselt/cones/cone_ltc.h>
#include <nusselt/cones/cone_projected_solid_angle.h>
#include <nusselt/cones/cone_solid_angle.h>
#include <nusselt/simd/pack.h>

namespace nusselt_test {

using nusselt::abs;
using nusselt::any;
using nusselt::is_finite;
using nusselt::select;

/// Numbers for one hostile light and one sample of it.
template <class T>
struct HostileRound {
    nusselt::Vec3<T> center, axis[3];
    nusselt::LtcCoefficients<T> lobe;
    nusselt::Vec2<T> u;
};

template <class T>
class HostileRounds {
public:
    explicit HostileRounds(unsigned seed) : engine_(seed) {}

    HostileRound<T> operator()() {
        HostileRound<T> h{};
        // Sizes and distances from much smaller to much larger than one another; sometimes all coordinates are small integers.
        const T scale = power(-26, 26);
        const T distance = scale * power(-9, 9);
        const bool is_even = chance(0.2);
        h.center = distance * vector(is_even);
        for (auto& axis : h.axis) {
            axis = scale * vector(is_even);
            if (chance(0.1)) axis = power(-12, 0) * axis;
            if (chance(0.02)) axis = {T(0), T(0), T(0)};
        }
        if (chance(0.3)) h.axis[1] = h.axis[0] + power(-12, 0) * h.axis[1];
        if (chance(0.2)) h.center.z = power(-9, 0) * h.center.z;
        if (chance(0.1)) h.center.z = 0;
        // Next to the surface, on it, or next to the rim.
        if (chance(0.3)) h.center = (T(1) + sign() * power(-9, 0)) * h.axis[0];
        if (chance(0.05)) h.center = h.axis[1];
        if (chance(0.1)) h.center = h.center + power(-9, 0) * h.axis[2];
        h.lobe = {power(-4, 0), power(-4, 0), power(-4, 0), -power(-4, 0), T(1), T(1)};
        if (chance(0.3)) h.lobe.m02 = h.lobe.m20 = 0;
        h.u = {random_number(), random_number()};
        return h;
    }

private:
    bool chance(double probability) { return uniform_(engine_) < probability; }
    T sign() { return chance(0.5) ? T(1) : T(-1); }
    T power(double low, double high) {
        return static_cast<T>(std::pow(10, low + (high - low) * uniform_(engine_)));
    }
    nusselt::Vec3<T> vector(bool is_even) {
        double c[3];
        for (double& x : c) x = is_even ? std::round(3 * uniform_(engine_) - 1.5) : normal_(engine_);
        return {static_cast<T>(c[0]), static_cast<T>(c[1]), static_cast<T>(c[2])};
    }
    T random_number() {
        const T last = 1 - std::numeric_limits<T>::epsilon() / 2;
        if (chance(0.1)) return 0;
        if (chance(0.1)) return last;
        if (chance(0.1)) return static_cast<T>(0.5);
        if (chance(0.1)) return power(-30, 0) < last ? power(-30, -1) : last;
        const auto u = static_cast<T>(uniform_(engine_));
        return u < last ? u : last;
    }

    std::mt19937_64 engine_;
    std::uniform_real_distribution<double> uniform_{0, 1};
    std::normal_distribution<double> normal_;
};

template <class Real>
auto disk_of(const HostileRound<Real>& h) {
    const auto normal = normalize(h.axis[2]);
    const auto missing = dot(normal, normal) == Real(0);
    return nusselt::Disk<Real>{
        h.center, select(missing, nusselt::Vec3<Real>{Real(0), Real(0), Real(1)}, normal), length(h.axis[0])};
}
template <class Real>
auto ellipse_of(const HostileRound<Real>& h) {
    return nusselt::Ellipse<Real>{h.center, h.axis[0], h.axis[1]};
}
template <class Real>
auto sphere_of(const HostileRound<Real>& h) {
    return nusselt::Sphere<Real>{h.center, length(h.axis[0])};
}
template <class Real>
auto ellipsoid_of(const HostileRound<Real>& h) {
    return nusselt::Ellipsoid<Real>{h.center, {h.axis[0], h.axis[1], h.axis[2]}};
}

template <class Real>
nusselt::mask_t<Real> is_finite_vector(const nusselt::Vec3<Real>& v) {
    return is_finite(v.x) & is_finite(v.y) & is_finite(v.z);
}

/// Calls report(mask, text) for each rule and the lanes that break it.
/// \param extent of the light and its distance [m].
template <class Real, class Technique, class Report>
void check_rules(const Technique& technique, const nusselt::Vec2<Real>& u, bool is_clipped,
                 const Real& extent, const Report& report) {
    using T = nusselt::scalar_t<Real>;
    constexpr T kTolerance = 84 * std::numeric_limits<T>::epsilon();
    const auto s = technique.sample(u);
    const Real pdf = technique.pdf(s.wi);
    const auto inverse = technique.invert(s.wi);
    const Real measure = technique.measure();
    report(!is_finite_vector(s.wi), "wi is not finite");
    report(!(is_finite(s.pdf) & (s.pdf >= Real(0))), "the density is negative or not finite");
    report(!(is_finite(measure) & (measure >= Real(0))), "the measure is negative or not finite");
    report(!((inverse.x >= Real(0)) & (inverse.x < Real(1)) & (inverse.y >= Real(0)) & (inverse.y < Real(1))),
           "invert(wi) leaves [0, 1)");
    report(s.pdf != pdf, "the density of the sample is not pdf(wi)");
    const auto sampled = s.pdf > Real(0);
    report(sampled & !(measure > Real(0)), "the density is positive without a measure");
    report(sampled & !(abs(dot(s.wi, s.wi) - Real(1)) <= Real(kTolerance)), "wi is not a unit vector");
    report(sampled & !is_finite_vector(s.p), "p is not finite");
    if (is_clipped) report(sampled & !(s.wi.z >= Real(0)), "wi is below the horizon");
    const Real slack = Real(kTolerance) * extent + Real(16 * std::numeric_limits<T>::min());
    const auto beside = cross(s.wi, s.p);
    report(sampled & !((abs(beside.x) <= slack) & (abs(beside.y) <= slack) & (abs(beside.z) <= slack)),
           "wi does not lead to p");
    report(sampled & !((abs(s.p.x) <= Real(2) * extent) & (abs(s.p.y) <= Real(2) * extent) &
                       (abs(s.p.z) <= Real(2) * extent)),
           "p is far from the light");
}

/// All techniques for all shapes.
template <class Real, class Report>
void check_all_rules(const HostileRound<Real>& h, const Report& report) {
    Real extent = length(h.center);
    for (const auto& axis : h.axis) extent = extent + length(axis);
    const nusselt::Ltc<Real> ltc(h.lobe);
    const auto check = [&](const auto& light, const char* shape) {
        const auto named = [&](const char* technique) {
            return [&report, shape, technique](const auto& mask, const char* text) {
                if (any(mask)) report(mask, std::string(shape) + ", " + technique + ": " + text);
            };
        };
        check_light(light, ltc, h.u, extent, named);
    };
    check(disk_of(h), "disk");
    check(ellipse_of(h), "ellipse");
    check(sphere_of(h), "sphere");
    check(ellipsoid_of(h), "ellipsoid");
}

template <class Real, template <class> class Light, class Named>
void check_light(const Light<Real>& light, const nusselt::Ltc<Real>& ltc, const nusselt::Vec2<Real>& u,
                 const Real& extent, const Named& named) {
    check_rules<Real>(nusselt::ConeProjectedSolidAngle<Real, Light>(light), u, true, extent,
                      named("projected"));
    check_rules<Real>(nusselt::ConeSolidAngle<Real, Light>(light), u, false, extent, named("solid angle"));
    check_rules<Real>(nusselt::ConeLtc<Real, Light>(light, ltc), u, false, extent, named("lobe"));
}

/// Packs of hostile lights.
template <class T, int N>
HostileRound<nusselt::Pack<T, N>> in_lanes(const HostileRound<T> (&lights)[N]) {
    using Real = nusselt::Pack<T, N>;
    HostileRound<Real> result;
    const auto set = [](nusselt::Vec3<Real>& to, const nusselt::Vec3<T>& from, int i) {
        to.x.set_lane(i, from.x);
        to.y.set_lane(i, from.y);
        to.z.set_lane(i, from.z);
    };
    for (int i = 0; i < N; ++i) {
        set(result.center, lights[i].center, i);
        for (int k = 0; k < 3; ++k) set(result.axis[k], lights[i].axis[k], i);
        const auto& from = lights[i].lobe;
        result.lobe.m00.set_lane(i, from.m00);
        result.lobe.m02.set_lane(i, from.m02);
        result.lobe.m11.set_lane(i, from.m11);
        result.lobe.m20.set_lane(i, from.m20);
        result.lobe.m22.set_lane(i, from.m22);
        result.lobe.albedo.set_lane(i, from.albedo);
        result.u.x.set_lane(i, lights[i].u.x);
        result.u.y.set_lane(i, lights[i].u.y);
    }
    return result;
}

} // namespace nusselt_test
