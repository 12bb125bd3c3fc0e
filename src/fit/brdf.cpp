#include "fit/brdf.h"

#include "fit/targets.h"

#include <nusselt/simd/pack.h>

#include <stdexcept>

namespace nusselt::fit {

namespace {

/// Wide enough for every processor; sums are added in the same order on each.
constexpr int kLanes = 8;
using Real = Pack<double, kLanes>;
static_assert(Nodes::kAround % kLanes == 0);

/// Cosine and sine of the azimuths of half a turn, at the centres of as many intervals.
template <int kAround>
struct Azimuths {
    alignas(64) double cos[kAround], sin[kAround];

    Azimuths() {
        for (int i = 0; i < kAround; ++i) {
            const double phi = kPi<double> * (i + 0.5) / kAround;
            cos[i] = std::cos(phi);
            sin[i] = std::sin(phi);
        }
    }
};

/// Calls f(first, cos_phi, sin_phi, v) for packs of nodes of a grid, v from the middles of intervals of [0, 1].
template <int kAround, int kOutwards, class Function>
void for_each_node(const Function& f) {
    static const Azimuths<kAround> azimuths;
    for (int j = 0; j < kOutwards; ++j)
        for (int i = 0; i < kAround; i += kLanes)
            f(j * kAround + i, Real::load(azimuths.cos + i), Real::load(azimuths.sin + i),
              Real((j + 0.5) / kOutwards));
}

double sum_of_lanes(const Real& x) {
    double lanes[kLanes];
    x.store(lanes);
    double sum = 0;
    for (const double lane : lanes) sum += lane;
    return sum;
}

template <template <class> class Target>
Moments moments(const Slice& slice) {
    constexpr int kAround = 64, kOutwards = 128;
    const Target<Real> target(slice);
    Real albedo(0), mean_x(0), mean_z(0);
    for_each_node<kAround, kOutwards>([&](int, const Real& cos_phi, const Real& sin_phi, const Real& v) {
        // More nodes where normals are steep: weights change fastest there.
        const Vec3<Real> wi = target.sample(cos_phi, sin_phi, Real(1) - v * v);
        const Real value = target.eval(wi);
        const Real weight = Real(2) * v * select(value > Real(0), value / target.pdf(wi), Real(0));
        albedo = albedo + weight;
        mean_x = mean_x + weight * wi.x;
        mean_z = mean_z + weight * wi.z;
    });
    const double away = std::max(-sum_of_lanes(mean_x), 0.0);
    return {sum_of_lanes(albedo) / (kAround * kOutwards), std::atan2(away, sum_of_lanes(mean_z))};
}

template <template <class> class Target>
void place_nodes(const Slice& slice, double albedo, Nodes& nodes) {
    const Target<Real> target(slice);
    for_each_node<Nodes::kAround, Nodes::kOutwards>(
        [&](int first, const Real& cos_phi, const Real& sin_phi, const Real& u_y) {
            const Vec3<Real> wi = target.sample(cos_phi, sin_phi, u_y);
            wi.x.store(&nodes.x[first]);
            wi.y.store(&nodes.y[first]);
            wi.z.store(&nodes.z[first]);
            (target.eval(wi) / Real(albedo)).store(&nodes.value[first]);
            target.pdf(wi).store(&nodes.pdf[first]);
        });
}

/// |a - b|^exponent.
Real power_of_difference(const Real& a, const Real& b, int exponent) {
    const Real difference = abs(a - b);
    Real power = difference;
    for (int i = 1; i < exponent; ++i) power = power * difference;
    return power;
}

/// A lobe, ready to be evaluated and sampled.
class LobeDensity {
public:
    explicit LobeDensity(const Lobe& lobe)
        : sin_peak_(std::sin(lobe.peak)),
          cos_peak_(std::cos(lobe.peak)),
          sin_tilt_(std::sin(lobe.tilt)),
          cos_tilt_(std::cos(lobe.tilt)),
          width_x_(lobe.width_x),
          width_y_(lobe.width_y),
          shear_(1 / std::cos(lobe.peak - lobe.tilt)),
          norm_(1 / (shear_ * lobe.width_x * lobe.width_y * kPi<double>)) {}

    Real eval(const Vec3<Real>& wi) const {
        const Real x = (Real(cos_peak_) * wi.x + Real(sin_peak_) * wi.z) / Real(width_x_);
        const Real y = wi.y / Real(width_y_);
        const Real z = max(Real(cos_tilt_) * wi.z - Real(sin_tilt_) * wi.x, Real(0));
        const Real length2 = x * x + y * y + z * z;
        return z * Real(norm_) / (length2 * length2);
    }

    /// The direction whose image in cosine space has the direction o.
    Vec3<Real> direction(const Vec3<Real>& o) const {
        const Real along = Real(shear_ * width_x_) * o.x;
        const Real up = Real(shear_) * o.z;
        return normalize(Vec3<Real>{Real(cos_tilt_) * along - Real(sin_peak_) * up, Real(width_y_) * o.y,
                                    Real(sin_tilt_) * along + Real(cos_peak_) * up});
    }

private:
    double sin_peak_, cos_peak_, sin_tilt_, cos_tilt_, width_x_, width_y_, shear_, norm_;
};

template <template <class> class Target>
double error(const Slice& slice, double albedo, const Nodes& nodes, const Lobe& lobe, int exponent) {
    const Target<Real> target(slice);
    const LobeDensity density(lobe);
    const Real inverse_albedo(1 / albedo);
    Real sum(0);
    for (int i = 0; i < Nodes::kCount; i += kLanes) {
        const Real lobe_value =
            density.eval({Real::load(&nodes.x[i]), Real::load(&nodes.y[i]), Real::load(&nodes.z[i])});
        sum = sum + power_of_difference(Real::load(&nodes.value[i]), lobe_value, exponent) /
                        (lobe_value + Real::load(&nodes.pdf[i]));
    }
    for_each_node<Nodes::kAround, Nodes::kOutwards>(
        [&](int, const Real& cos_phi, const Real& sin_phi, const Real& u_y) {
            const Real r = sqrt(u_y);
            const Vec3<Real> wi = density.direction({r * cos_phi, r * sin_phi, sqrt(Real(1) - u_y)});
            const Real lobe_value = density.eval(wi);
            sum = sum + power_of_difference(target.eval(wi) * inverse_albedo, lobe_value, exponent) /
                            (lobe_value + target.pdf(wi));
        });
    return sum_of_lanes(sum) / Nodes::kCount;
}

template <template <class> class Target>
Brdf brdf(const char* name, const char* description) {
    return {name, description, moments<Target>, place_nodes<Target>, error<Target>};
}

} // namespace

const std::vector<Brdf>& brdfs() {
    static const std::vector<Brdf> list = {
        brdf<FrostbiteSpecular>("frostbite-specular", "GGX with height-correlated Smith and Schlick"),
        brdf<FrostbiteDiffuse>("frostbite-diffuse", "Disney diffuse, renormalised"),
        brdf<LambertTarget>("lambert", "the cosine itself"),
        brdf<PhongSpecular>("phong",
                            "a power of the cosine with the mirrored direction, by the roughness of a "
                            "Beckmann lobe that is as wide"),
    };
    return list;
}

const Brdf& find_brdf(const std::string& name) {
    std::string names;
    for (const Brdf& one : brdfs()) {
        if (one.name == name) return one;
        names += (names.empty() ? "" : ", ") + std::string(one.name);
    }
    throw std::runtime_error("unknown BRDF '" + name + "'; use one of " + names);
}

} // namespace nusselt::fit
