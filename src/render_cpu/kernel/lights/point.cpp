// Point lights: isotropic ones, spots and images.

#include "render_cpu/kernel/lights/luminaire.h"
#include "render_cpu/kernel/lights/one_direction.h"
#include "render_cpu/kernel/single_lane.h"
#include "render_cpu/kernel/texture.h"
#include "render_cpu/lights/point_records.h"

#include <nusselt/emission/latitude_longitude.h>
#include <nusselt/emission/octahedral_map.h>

#include <limits>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

using scene::PointDistribution;

Vector grey(const Real& value) noexcept { return {value, value, value}; }

/// \param across the part of the direction across the axis
/// \param along  its cosine with the axis
Real cone(const render_cpu::PointRecord& light, const Vector& across, const Real& along) noexcept {
    // 1 - cosine, which a difference would cancel in narrow cones.
    const Real x =
        select(along > Real(0), dot(across, across) / (Real(1) + max(along, Real(0))), Real(1) - along);
    const Real t = max(min((Real(light.cone_end) - x) * Real(light.inverse_cone_width), Real(1)), Real(0));
    if (light.distribution == PointDistribution::quartic_cone) return (t * t) * (t * t);
    return t * t * (Real(3) - Real(2) * t);
}

/// \param place with v downwards, while rows of textures are numbered upwards
Vector texel(const render_cpu::KernelScene& scene, const render_cpu::PointRecord& light,
             const Vec2<Real>& place, LaneMask active) noexcept {
    if (light.texture < 0) return grey(Real(1));
    return look_up_texture(scene.textures[light.texture], {place.x, Real(1) - place.y}, active);
}

Vector projection(const render_cpu::KernelScene& scene, const render_cpu::PointRecord& light, const Vector& w,
                  LaneMask active) noexcept {
    const auto is_ahead = w.z > Real(0);
    const Real depth = select(is_ahead, w.z, Real(1));
    const Real x = w.x / (depth * Real(light.half_extent.x));
    const Real y = w.y / (depth * Real(light.half_extent.y));
    const auto is_inside = is_ahead & (max(abs(x), abs(y)) <= Real(1));
    const Vec2<Real> place{Real(0.5f) + Real(0.5f) * x, Real(0.5f) + Real(0.5f) * y};
    return select(is_inside, texel(scene, light, place, active & is_inside), grey(Real(0)));
}

Real luminaire(const render_cpu::PointRecord& light, const Vector& w) noexcept {
    alignas(4 * kLanes) float share[kLanes];
    for (int i = 0; i < kLanes; ++i) share[i] = intensity_in(light.luminaire, single_lane<Vec3<float>>(w, i));
    return Real::load(share);
}

/// The share of the intensity in a direction. \param away unit, in world space
Vector share(const render_cpu::KernelScene& scene, const render_cpu::PointRecord& light, const Vector& away,
             LaneMask active) noexcept {
    const Vector w{dot(broadcast<Real>(to_vec(light.x_axis)), away),
                   dot(broadcast<Real>(to_vec(light.y_axis)), away),
                   dot(broadcast<Real>(to_vec(light.z_axis)), away)};
    switch (light.distribution) {
    case PointDistribution::isotropic:
        break;
    case PointDistribution::smooth_cone:
    case PointDistribution::quartic_cone:
        return grey(cone(light, away - w.z * broadcast<Real>(to_vec(light.z_axis)), w.z));
    case PointDistribution::octahedral_image:
        return texel(scene, light, octahedral_coordinates(w), active);
    case PointDistribution::latitude_image:
        return texel(scene, light, latitude_longitude_coordinates(w), active);
    case PointDistribution::projected_image:
        return projection(scene, light, w, active);
    case PointDistribution::profile:
        return grey(luminaire(light, w));
    }
    return grey(Real(1));
}

struct PointLight {
    using Shape = OneDirection;

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const auto& record = static_cast<const render_cpu::PointRecord*>(lights.records)[index];
        const Vector way = broadcast<Real>(to_vec(record.position)) - reflected.surface().position;
        const Real squared = dot(way, way);
        // A light in the shading point itself has no direction. NaN stays.
        const LaneMask usable = !(squared <= Real(std::numeric_limits<float>::min()));
        const Real inverse = Real(1) / sqrt(select(usable, squared, Real(1)));
        const Vector to_light = inverse * way;
        const Vector intensity =
            bounded(broadcast<Real>(to_vec(record.intensity)) *
                    share(reflected.job().scene, record, -to_light, reflected.lanes() & usable));
        return light_in_direction(reflected, to_light, way, usable, (inverse * inverse) * intensity,
                                  lights.first + index);
    }

    static LobeIntegrals integrals(const Shape& shape, const Ltc<Real>& lobe) noexcept {
        return lobes_in_direction(shape, lobe);
    }
};

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

LightCode point_code(LaneCount<kernel::kLanes>) { return kernel::one_direction_code<kernel::PointLight>(); }

} // namespace nusselt::render_cpu
