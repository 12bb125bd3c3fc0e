#pragma once
/// Linear lights, strips and tubes.

#include "render_cpu/kernel/analytic.h"
#include "render_cpu/kernel/lights/luminaire.h"
#include "render_cpu/kernel/reflected_light.h"
#include "render_cpu/kernel/single_lane.h"
#include "render_cpu/kernel/single_technique.h"
#include "render_cpu/lights/line_records.h"

#include <nusselt/geometry/cylinder_caps.h>
#include <nusselt/geometry/strip.h>
#include <nusselt/line_emission/textured_line.h>
#include <nusselt/line_emission/visible_part.h>
#include <nusselt/ltc/line_shading.h>
#include <nusselt/sampling/cylinder_area.h>
#include <nusselt/sampling/cylinder_projected_solid_angle.h>
#include <nusselt/sampling/cylinder_solid_angle.h>
#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

inline const render_cpu::LineRecord& line_record(const render_cpu::LightSet& lights,
                                                 std::int32_t index) noexcept {
    return static_cast<const render_cpu::LineRecord*>(lights.records)[index];
}

/// The middle line of a light in shading space, without what its spread hides.
inline LineSegment<Real> local_axis(const ReflectedLight& reflected,
                                    const render_cpu::LineRecord& record) noexcept {
    const LineSegment<float> world{to_vec(record.begin), to_vec(record.direction), record.length};
    const Frame<Real>& frame = reflected.surface().frame;
    const LineSegment<Real> whole = to_shading_space(world, reflected.surface().position, frame);
    if (record.directions == nullptr || !(record.directions->inverse_slope > 0)) return whole;
    const Real slope(1 / record.directions->inverse_slope);
    switch (record.model) {
    case scene::TubeModel::strip:
        return visible_part_of_strip(
            whole, frame.to_local(broadcast<Real>(to_vec(record.directions->normal))), slope);
    case scene::TubeModel::linear:
        return visible_part(whole, slope);
    default:
        return visible_part_of_tube(whole, Real(record.radius), slope);
    }
}

using LineRadiance = LineProfile<float, scene::kMaxLineTexels>;

/// Radiance along a light over its mean.
struct RelativeRadiance {
    const LineRadiance* profile; ///< null for uniform radiance
    Vec3<float> inverse_mean;

    explicit RelativeRadiance(const render_cpu::LineRecord& record) noexcept
        : profile(static_cast<const LineRadiance*>(record.profile)),
          inverse_mean(to_vec(record.inverse_mean)) {}

    /// Multiplies a sample by the radiance at its point.
    void modulate(const LineSegment<Real>& axis, DirectLightSample<Real>& sample) const noexcept {
        if (profile == nullptr) return;
        const Real at = dot(sample.p - axis.p0, axis.s) / axis.length;
        // Comparisons with NaN are false.
        const Vector radiance = profile->lookup(select(at > Real(0), min(at, Real(1)), Real(0)));
        sample.shadowed = (broadcast<Real>(inverse_mean) * radiance) * sample.shadowed;
    }
};

/// The share of radiance that the spread of a lateral surface or a strip passes as a whole. \param away unit, in world space
inline float whole_spread_share(const render_cpu::LineRecord& record, const Vec3<float>& away) noexcept {
    const render_cpu::LineProfileRecord& profile = *record.directions;
    if (!(profile.inverse_slope > 0)) return 1;
    if (record.model == scene::TubeModel::strip) return spread_share(profile, to_vec(profile.normal), away);
    const float along = dot(to_vec(record.direction), away);
    const float sine = sqrt(max(1 - along * along, kTiny<float>));
    const float at = abs(along) / sine * profile.inverse_slope * render_cpu::kTubeSpreadCells;
    if (!(at < render_cpu::kTubeSpreadCells)) return 0;
    const int i = static_cast<int>(at);
    const float share = at - static_cast<float>(i);
    return (1 - share) * profile.spread[i] + share * profile.spread[i + 1];
}

/// The luminance of the profile of a light over its mean. \param away unit, in world space
inline float luminance_of_line(const render_cpu::LineProfileRecord& profile,
                               const Vec3<float>& away) noexcept {
    return relative_luminance(profile, {dot(to_vec(profile.x_axis), away), dot(to_vec(profile.y_axis), away),
                                        dot(to_vec(profile.z_axis), away)});
}

/// The radiance of a light with a profile over its mean, as that of a linear light or a strip. \param away unit, in world space
inline float radiance_of_line(const render_cpu::LineRecord& record, const Vec3<float>& away) noexcept {
    return whole_spread_share(record, away) * luminance_of_line(*record.directions, away);
}

/// Multiplies a sample by a function of lanes and of directions away from the light in world space.
template <class Factor>
void modulate_by_direction(const Surface& surface, const Factor& factor,
                           DirectLightSample<Real>& sample) noexcept {
    const Vector away = surface.frame.to_world(-sample.wi);
    alignas(4 * kLanes) float factors[kLanes];
    for (int i = 0; i < kLanes; ++i) factors[i] = factor(i, single_lane<Vec3<float>>(away, i));
    sample.shadowed = Real::load(factors) * sample.shadowed;
}

/// A line in shading space.
struct LocalLine : LineSegment<Real> {
    RelativeRadiance radiance;
    const render_cpu::LineRecord* record;

    void modulate(const Surface& surface, DirectLightSample<Real>& sample) const noexcept {
        radiance.modulate(*this, sample);
        if (record->directions == nullptr) return;
        const auto factor = [&](int /*lane*/, const Vec3<float>& away) {
            return radiance_of_line(*record, away);
        };
        modulate_by_direction(surface, factor, sample);
    }
};

/// Tubes and strips in the limit of a vanishing width.
struct LinearLight {
    using Shape = LocalLine;

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const render_cpu::LineRecord& record = line_record(lights, index);
        const LineSegment<Real> local = local_axis(reflected, record);
        const Real end = local.p0.z + local.length * local.s.z;
        Vector emission = broadcast<Real>(to_vec(record.radiance_times_radius));
        if (record.model == scene::TubeModel::strip) {
            const Vector normal = reflected.surface().frame.to_local(broadcast<Real>(to_vec(record.normal)));
            emission = strip_facing(local, normal) * emission;
        }
        return {{local, RelativeRadiance(record), &record},
                reflected.lanes() & !(max(local.p0.z, end) <= Real(0)) & !(local.length <= Real(0)),
                emission,
                static_cast<std::uint32_t>(lights.first + index)};
    }

    static auto technique(TechniqueTag<render::Technique::area>, const Shape& shape) noexcept {
        return LineArea<Real>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::solid_angle>, const Shape& shape) noexcept {
        return LineSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::clipped_solid_angle>, const Shape& shape) noexcept {
        return LineClippedSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::projected_solid_angle>,
                          const Shape& shape) noexcept {
        return LineProjectedSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::projected_solid_angle_biased>,
                          const Shape& shape) noexcept {
        return LineProjectedSolidAngle<Real>(shape);
    }

    static LobeIntegrals integrals(const Shape& shape, const Ltc<Real>& lobe) noexcept {
        return {diffuse_integral(shape), lobe_integral<BothHorizons>(shape, lobe)};
    }
};

/// A closed cylinder. Its caps are bright if it is solid, and dark if it is open.
struct Tube : Cylinder<Real> {
    scene::TubeModel model;
    RelativeRadiance radiance;
    const render_cpu::LineProfileRecord* directions; ///< null for the same radiance in all directions

    void modulate(const Surface& surface, DirectLightSample<Real>& sample) const noexcept {
        radiance.modulate(axis, sample);
        if (directions != nullptr) modulate_by_profile(surface, sample);
        if (model != scene::TubeModel::open) return;
        const Vector zero{Real(0), Real(0), Real(0)};
        sample.shadowed = select(meets_cap(*this, sample.wi), zero, sample.shadowed);
    }

    /// The integral of a lobe over the caps as small disks. \param density of the lobe
    template <class Density>
    Real caps(const Density& density) const noexcept {
        return model == scene::TubeModel::open ? Real(0) : caps_integral(axis, radius, density);
    }

private:
    void modulate_by_profile(const Surface& surface, DirectLightSample<Real>& sample) const noexcept {
        // The normal of the lateral surface, or of a cap.
        const Vector from_start = sample.p - axis.p0;
        const Vector across = from_start - dot(from_start, axis.s) * axis.s;
        const Vector lateral = Real(1) / sqrt(max(dot(across, across), Real(kTiny<float>))) * across;
        const Vector normal = select(meets_cap(*this, sample.wi), axis.s, lateral);
        sample.shadowed = spread_share(*directions, normal, sample.wi) * sample.shadowed;
        const auto factor = [&](int /*lane*/, const Vec3<float>& away) {
            return luminance_of_line(*directions, away);
        };
        modulate_by_direction(surface, factor, sample);
    }
};

/// The integral of a lobe over a tube as Heitz and Hill approximate it: the axis as a linear light, and small disks.
struct TubeIntegral {
    Real side, caps;

    Real whole() const noexcept { return tube_integral(side, Real(1), caps); }
};

/// Tubes of a finite radius.
struct TubeLight {
    using Shape = Tube;

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const render_cpu::LineRecord& record = line_record(lights, index);
        const LineSegment<Real> l = local_axis(reflected, record);
        const Real slope = sqrt(max(Real(1) - l.s.z * l.s.z, Real(0)));
        const Real highest = max(l.p0.z, l.p0.z + l.length * l.s.z) + Real(record.radius) * slope;
        return {{{l, Real(record.radius)}, record.model, RelativeRadiance(record), record.directions},
                reflected.lanes() & !(highest <= Real(0)),
                broadcast<Real>(to_vec(record.radiance)),
                static_cast<std::uint32_t>(lights.first + index)};
    }

    static auto technique(TechniqueTag<render::Technique::area>, const Shape& shape) noexcept {
        return CylinderArea<Real>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::solid_angle>, const Shape& shape) noexcept {
        return CylinderSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::clipped_solid_angle>, const Shape& shape) noexcept {
        return CylinderSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::projected_solid_angle>,
                          const Shape& shape) noexcept {
        return CylinderProjectedSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<render::Technique::projected_solid_angle_biased>,
                          const Shape& shape) noexcept {
        return CylinderProjectedSolidAngle<Real>(shape);
    }

    static TubeIntegral diffuse(const Shape& shape) noexcept {
        const auto cosine = [](const Vector& wi) { return Real(1 / kPi<float>) * max(wi.z, Real(0)); };
        return {diffuse_integral(shape.axis) * shape.radius, shape.caps(cosine)};
    }
    static TubeIntegral specular(const Shape& shape, const Ltc<Real>& lobe) noexcept {
        const auto density = [&](const Vector& wi) {
            return select(wi.z > Real(0), lobe.density(wi), Real(0));
        };
        return {lobe_integral<BothHorizons>(shape.axis, lobe) * shape.radius, shape.caps(density)};
    }
    static LobeIntegrals integrals(const Shape& shape, const Ltc<Real>& lobe) noexcept {
        return {diffuse(shape).whole(), specular(shape, lobe).whole()};
    }
};

/// The functions that take points of such lights as a job demands.
render_cpu::AddLight line_points(const render_cpu::RenderJob& job) noexcept;
render_cpu::AddLight tube_points(const render_cpu::RenderJob& job) noexcept;
/// The same for lights whose radiance varies.
render_cpu::AddLight textured_lines(const render_cpu::RenderJob& job) noexcept;
render_cpu::AddLight textured_tubes(const render_cpu::RenderJob& job) noexcept;
/// The same for lights whose radiance depends on the direction.
render_cpu::AddLight profiled_lines(const render_cpu::RenderJob& job) noexcept;
render_cpu::AddLight profiled_tubes(const render_cpu::RenderJob& job) noexcept;

} // namespace kernel
NUSSELT_NAMESPACE_END
