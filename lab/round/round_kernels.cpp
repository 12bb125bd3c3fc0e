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
#include <nusselt/related/sphere_solid_angle_wang.h>

NUSSELT_NAMESPACE_BEGIN
namespace round_kernels {

using lab::kRoundLights;
using lab::kRoundSamples;
using lab::RoundLights;
using lab::RoundOrigin;
using lab::RoundTechnique;
using lab::RoundWeights;

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

/// Makes the compiler believe that an object is read completely. What only some members need would not be computed otherwise.
template <class T>
void escape(const T& object) {
    asm volatile("" : : "r"(&object) : "memory");
}

template <class Technique, class Light>
void weigh(const RoundLights& lights, RoundWeights& weights) {
    for (int i = 0; i < kRoundLights; ++i) {
        const Light light = light_at<Light>(lights, i);
        const Technique technique(light);
        for (int k = 0; k < kRoundSamples; ++k) {
            const auto s = technique.sample({lights.u[i][k][0], lights.u[i][k][1]});
            const float cosine = max(s.wi.z, 0.0f);
            weights.of[i][k] = s.pdf > 0 && hits(light, s.wi) ? cosine / s.pdf : 0.0f;
        }
    }
}

template <class Technique, class Light>
void prepare(const RoundLights& lights, int times) {
    for (int n = 0; n < times; ++n) {
        for (int i = 0; i < kRoundLights; ++i) {
            const Technique technique(light_at<Light>(lights, i));
            escape(technique);
        }
    }
}

template <class Technique, class Light>
void prepare_and_sample(const RoundLights& lights, int times) {
    for (int n = 0; n < times; ++n) {
        for (int i = 0; i < kRoundLights; ++i) {
            const Technique technique(light_at<Light>(lights, i));
            escape(technique);
            for (int k = 0; k < kRoundSamples; ++k)
                escape(technique.sample({lights.u[i][k][0], lights.u[i][k][1]}));
        }
    }
}

template <class Technique, class Light>
constexpr RoundTechnique row(const char* name, RoundOrigin origin) {
    return {name, origin, weigh<Technique, Light>, prepare<Technique, Light>,
            prepare_and_sample<Technique, Light>};
}

/// The variant with small backward errors for lights that touch the point, and that of the renderers.
template <template <class> class Light>
using Ours = ConeProjectedSolidAngle<float, Light, kConeSteps<float>, kFineConePlaces>;
template <template <class> class Light>
using OursOfRenderers = ConeProjectedSolidAngle<float, Light, kConeSteps<float>, kConePlaces>;

inline constexpr RoundTechnique kSpheres[] = {
    row<Ours<Sphere>, Sphere<float>>("ours, up to 64 nodes", RoundOrigin::ours),
    row<OursOfRenderers<Sphere>, Sphere<float>>("ours, 16 nodes", RoundOrigin::other),
    row<SphereProjectedSolidAnglePeters<float>, Sphere<float>>("Peters and Dachsbacher 2019",
                                                               RoundOrigin::other),
    row<SphereProjectedSolidAngleUrena<float>, Sphere<float>>("Ureña and Georgiev 2018", RoundOrigin::other),
    row<SphereSolidAngleWang<float>, Sphere<float>>("solid angle, Wang 1992", RoundOrigin::usual),
    row<ConeSolidAngle<float, Sphere>, Sphere<float>>("ours, solid angle", RoundOrigin::other),
    row<SphereArea<float>, Sphere<float>>("area", RoundOrigin::other),
};
inline constexpr RoundTechnique kDisks[] = {
    row<Ours<Disk>, Disk<float>>("ours, up to 64 nodes", RoundOrigin::ours),
    row<OursOfRenderers<Disk>, Disk<float>>("ours, 16 nodes", RoundOrigin::other),
    row<ConeProjectedRejectionGamito<float, Disk>, Disk<float>>("Gamito 2016, projected rectangle",
                                                                RoundOrigin::other),
    row<ConeSolidAngle<float, Disk>, Disk<float>>("ours, solid angle", RoundOrigin::usual),
    row<ConeSolidAngleGuillen<float, Disk>, Disk<float>>("Guillén et al. 2017", RoundOrigin::other),
    row<ConeRejectionGamito<float, Disk>, Disk<float>>("Gamito 2016", RoundOrigin::other),
    row<EllipseArea<float, Disk>, Disk<float>>("area", RoundOrigin::other),
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
