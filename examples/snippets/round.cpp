// The code in docs/techniques/elliptic_cone.md, as functions. The tests compile this file and compare what the functions return
// with closed forms.

#include <nusselt/nusselt.h>
using namespace nusselt;

namespace {

using Vec = Vec3<float>;

constexpr float kAlbedo = 0.5f;
float brdf(const Vec&, const Vec&) { return kAlbedo / kPi<float>; }

/// There is nothing but the light.
bool visible(const Vec&, const Vec&) { return true; }

/// \param axis of unit length, on the side that emits.
float light_of_disk(const Vec& center, const Vec& axis, float radius, float emitted, const Vec& point,
                    const Vec& normal, const Vec2<float>& u) {
    const Vec wo{0, 0, 1};
    float radiance = 0;
    const Disk<float> disk{center, axis, radius}; // once per light, in the world

    const auto frame = Frame<float>::from_normal(normal); // at each shading point
    const auto light = to_shading_space(disk, point, frame);
    if (dot(light.normal, light.center) >= 0) return 0; // the point is behind the disk
    const DiskProjectedSolidAngle<float> technique(light);
    const auto s = technique.sample(u);
    if (s.pdf > 0 && visible(point, point + frame.to_world(s.p)))
        radiance += emitted * brdf(wo, s.wi) * s.wi.z / s.pdf;
    return radiance;
}

/// The projected solid angles of a sphere, an ellipse and an ellipsoid, seen from a point, and the share of a diffuse surface's light
/// that comes from the ellipsoid's directions.
void other_shapes(const Vec& center, float radius, const Vec& u, const Vec& v, const Vec& w, const Vec& point,
                  const Frame<float>& frame, float (&measures)[3], float& share) {
    const Sphere<float> sphere{center, radius};
    const Ellipse<float> ellipse{center, u, v};          // two conjugate semi-diameters
    const Ellipsoid<float> ellipsoid{center, {u, v, w}}; // three of them
    const SphereProjectedSolidAngle<float> of_sphere(to_shading_space(sphere, point, frame));
    const EllipseProjectedSolidAngle<float> of_ellipse(to_shading_space(ellipse, point, frame));
    const EllipsoidProjectedSolidAngle<float> of_ellipsoid(to_shading_space(ellipsoid, point, frame));

    share = round_diffuse_integral(to_shading_space(ellipsoid, point, frame)); // measure() over pi

    measures[0] = of_sphere.measure();
    measures[1] = of_ellipse.measure();
    measures[2] = of_ellipsoid.measure();
}

/// The glossy light of a sphere by one sample, and the integral of the lobe over the part of it above the surface.
float light_of_glossy_sphere(const Sphere<float>& sphere, float emitted, const Vec& point, const Vec& normal,
                             const Vec& wo, const LtcCoefficients<float>& coefficients, const Vec2<float>& u,
                             float& share) {
    float radiance = 0;
    const auto frame = shading_frame(normal, wo);
    const Ltc<float> lobe(coefficients); // of the table, at the roughness and the inclination of wo
    const SphereClippedLtc<float> technique(to_shading_space(sphere, point, frame), lobe);
    const auto s = technique.sample(u);
    if (s.pdf > 0 && visible(point, point + frame.to_world(s.p)))
        radiance += emitted * coefficients.albedo * lobe.density(s.wi) / s.pdf;

    const ConeClippedLtc<float, Sphere, kConeSteps<float>, kFineConePlaces> fine(
        to_shading_space(sphere, point, frame), lobe);
    share = fine.measure();
    return radiance;
}

} // namespace
