/// Techniques for spheres and disks as scalars, compiled for AVX2; see round_kernels.h.

#include "lab/round/round_kernels.h"

#include <nusselt/cones/cone_projected_solid_angle.h>
#include <nusselt/cones/cone_solid_angle.h>
#include <nusselt/cones/ellipse_area.h>
#include <nusselt/related/cone_rejection_gamito.h>
#include <nusselt/related/cone_solid_angle_guillen.h>
#include <nusselt/related/sphere_area.h>
#include <nusselt/related/sphere_projected_solid_angle_peters.h>
#include <nusselt/related/sphere_projected_solid_angle_urena.h>

NUSSELT_NAMESPACE_BEGIN
namespace round_kernels {

using lab::kRoundLights;
using lab::kRoundSamples;
using lab::RoundLights;
using lab::RoundTechnique;

inline Vec3<float> vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

template <class Light>
Light light_at(const RoundLights& lights, int i);
template <>
inline Sphere<float> light_at(const RoundLights& lights, int i) {
    return {vector(lights.center[i]), lights.radius[i]};
}
template <>
inline Disk<float> light_at(const RoundLights& lights, int i) {
    return {vector(lights.center[i]), vector(lights.normal[i]), lights.radius[i]};
}

/// Whether a ray meets a light that is larger by a thousandth.
inline bool hits(const Sphere<float>& light, const Vec3<float>& wi) {
    const Vec3<double> c = broadcast<double>(light.center), d = broadcast<double>(wi);
    return dot(c, d) > 0 && length(cross(c, d)) <= 1.001 * static_cast<double>(light.radius) * length(d);
}
inline bool hits(const Disk<float>& light, const Vec3<float>& wi) {
    const Vec3<double> c = broadcast<double>(light.center), d = broadcast<double>(wi);
    const Vec3<double> n = broadcast<double>(light.normal);
    const double distance = dot(c, n) / dot(d, n);
    return distance > 0 && length(distance * d - c) <= 1.001 * static_cast<double>(light.radius);
}

template <class Technique, class Light>
void weigh(const RoundLights& lights, float (&weight)[kRoundLights][kRoundSamples]) {
    for (int i = 0; i < kRoundLights; ++i) {
        const Light light = light_at<Light>(lights, i);
        const Technique technique(light);
        for (int k = 0; k < kRoundSamples; ++k) {
            const auto s = technique.sample({lights.u[i][k][0], lights.u[i][k][1]});
            const float cosine = max(s.wi.z, 0.0f);
            weight[i][k] = s.pdf > 0 && hits(light, s.wi) ? cosine / s.pdf : 0.0f;
        }
    }
}

template <class Technique, class Light>
float prepare(const RoundLights& lights) {
    float sum = 0;
    for (int i = 0; i < kRoundLights; ++i) sum += Technique(light_at<Light>(lights, i)).measure();
    return sum;
}

template <class Technique, class Light>
float prepare_and_sample(const RoundLights& lights) {
    float sum = 0;
    for (int i = 0; i < kRoundLights; ++i) {
        const Technique technique(light_at<Light>(lights, i));
        for (int k = 0; k < kRoundSamples; ++k) {
            const auto s = technique.sample({lights.u[i][k][0], lights.u[i][k][1]});
            sum += s.pdf + s.p.x + s.wi.z;
        }
    }
    return sum;
}

enum class Origin { ours, usual, published };

template <class Technique, class Light>
constexpr RoundTechnique row(const char* name, Origin origin) {
    return {name,
            origin == Origin::ours,
            origin == Origin::usual,
            weigh<Technique, Light>,
            prepare<Technique, Light>,
            prepare_and_sample<Technique, Light>};
}

/// The variant with small backward errors for lights that touch the point.
template <template <class> class Light>
using Ours = ConeProjectedSolidAngle<float, Light, kConeSteps<float>, kFineConePlaces>;

inline constexpr RoundTechnique kSpheres[] = {
    row<Ours<Sphere>, Sphere<float>>("ours, projected solid angle", Origin::ours),
    row<SphereProjectedSolidAnglePeters<float>, Sphere<float>>("Peters and Dachsbacher 2019",
                                                               Origin::published),
    row<SphereProjectedSolidAngleUrena<float>, Sphere<float>>("Ureña and Georgiev 2018", Origin::published),
    row<ConeSolidAngle<float, Sphere>, Sphere<float>>("solid angle (Wang 1992)", Origin::usual),
    row<SphereArea<float>, Sphere<float>>("area", Origin::published),
};
inline constexpr RoundTechnique kDisks[] = {
    row<Ours<Disk>, Disk<float>>("ours, projected solid angle", Origin::ours),
    row<ConeProjectedRejectionGamito<float, Disk>, Disk<float>>("Gamito 2016, projected rectangle",
                                                                Origin::published),
    row<ConeSolidAngle<float, Disk>, Disk<float>>("ours, solid angle", Origin::usual),
    row<ConeSolidAngleGuillen<float, Disk>, Disk<float>>("Guillén et al. 2017", Origin::published),
    row<ConeRejectionGamito<float, Disk>, Disk<float>>("Gamito 2016", Origin::published),
    row<EllipseArea<float, Disk>, Disk<float>>("area", Origin::published),
};

template <int n>
constexpr lab::RoundTechniques list(const RoundTechnique (&rows)[n]) {
    return {rows, n};
}

} // namespace round_kernels
NUSSELT_NAMESPACE_END

namespace nusselt::lab {

RoundTechniques techniques_for_spheres() { return round_kernels::list(round_kernels::kSpheres); }
RoundTechniques techniques_for_disks() { return round_kernels::list(round_kernels::kDisks); }

} // namespace nusselt::lab
