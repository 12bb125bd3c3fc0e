// Linear lights, strips and tubes.

#include "render_cpu/kernel/point_samples.h"
#include "render_cpu/lights/line_records.h"

#include <nusselt/geometry/cylinder_caps.h>
#include <nusselt/geometry/strip.h>
#include <nusselt/ltc/line_shading.h>
#include <nusselt/sampling/cylinder_area.h>
#include <nusselt/sampling/cylinder_projected_solid_angle.h>
#include <nusselt/sampling/cylinder_solid_angle.h>
#include <nusselt/sampling/line_area.h>
#include <nusselt/sampling/line_projected_solid_angle.h>
#include <nusselt/sampling/line_solid_angle.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

using render::Technique;

const render_cpu::LineRecord& line_record(const render_cpu::LightSet& lights, std::int32_t index) noexcept {
    return static_cast<const render_cpu::LineRecord*>(lights.records)[index];
}

LineSegment<Real> local_axis(const ReflectedLight& reflected, const render_cpu::LineRecord& record) noexcept {
    const LineSegment<float> world{to_vec(record.begin), to_vec(record.direction), record.length};
    return to_shading_space(world, reflected.surface().position, reflected.surface().frame);
}

/// Tubes and strips in the limit of a vanishing width.
struct LinearLight {
    using Shape = LineSegment<Real>;

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const render_cpu::LineRecord& record = line_record(lights, index);
        const Shape local = local_axis(reflected, record);
        const Real end = local.p0.z + local.length * local.s.z;
        Vector emission = broadcast<Real>(to_vec(record.radiance_times_radius));
        if (record.model == scene::TubeModel::strip) {
            const Vector normal = reflected.surface().frame.to_local(broadcast<Real>(to_vec(record.normal)));
            emission = strip_facing(local, normal) * emission;
        }
        return {local, reflected.lanes() & !(max(local.p0.z, end) <= Real(0)), emission,
                static_cast<std::uint32_t>(lights.first + index)};
    }

    static auto technique(TechniqueTag<Technique::area>, const Shape& shape) noexcept {
        return LineArea<Real>(shape);
    }
    static auto technique(TechniqueTag<Technique::solid_angle>, const Shape& shape) noexcept {
        return LineSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<Technique::clipped_solid_angle>, const Shape& shape) noexcept {
        return LineClippedSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<Technique::projected_solid_angle>, const Shape& shape) noexcept {
        return LineProjectedSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<Technique::projected_solid_angle_biased>,
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

    void modulate(const Surface& /*surface*/, DirectLightSample<Real>& sample) const noexcept {
        if (model != scene::TubeModel::open) return;
        const Vector zero{Real(0), Real(0), Real(0)};
        sample.shadowed = select(meets_cap(*this, sample.wi), zero, sample.shadowed);
    }

    /// The integral over the tube as Heitz and Hill approximate it: its caps are small disks.
    /// \param along_axis integral of a lobe over the axis, per radius
    /// \param density    of the lobe
    template <class Density>
    Real integral(const Real& along_axis, const Density& density) const noexcept {
        if (model == scene::TubeModel::open) return tube_integral(along_axis, radius);
        return tube_integral(along_axis, radius, caps_integral(axis, radius, density));
    }
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
        return {{{l, Real(record.radius)}, record.model},
                reflected.lanes() & !(highest <= Real(0)),
                broadcast<Real>(to_vec(record.radiance)),
                static_cast<std::uint32_t>(lights.first + index)};
    }

    static auto technique(TechniqueTag<Technique::area>, const Shape& shape) noexcept {
        return CylinderArea<Real>(shape);
    }
    static auto technique(TechniqueTag<Technique::solid_angle>, const Shape& shape) noexcept {
        return CylinderSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<Technique::clipped_solid_angle>, const Shape& shape) noexcept {
        return CylinderSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<Technique::projected_solid_angle>, const Shape& shape) noexcept {
        return CylinderProjectedSolidAngle<Real>(shape);
    }
    static auto technique(TechniqueTag<Technique::projected_solid_angle_biased>,
                          const Shape& shape) noexcept {
        return CylinderProjectedSolidAngle<Real>(shape);
    }

    static LobeIntegrals integrals(const Shape& shape, const Ltc<Real>& lobe) noexcept {
        const auto cosine = [](const Vector& wi) { return Real(1 / kPi<float>) * max(wi.z, Real(0)); };
        const auto density = [&](const Vector& wi) {
            return select(wi.z > Real(0), lobe.density(wi), Real(0));
        };
        return {shape.integral(diffuse_integral(shape.axis), cosine),
                shape.integral(lobe_integral<BothHorizons>(shape.axis, lobe), density)};
    }
};

void choose(const render_cpu::RenderJob& job, render_cpu::AddLight (&add)[render_cpu::kMostShapes]) noexcept {
    add[0] = point_samples<LinearLight>(job);
    add[1] = point_samples<TubeLight>(job);
}

std::int32_t shape_of(const render_cpu::LightSet& lights, std::int32_t index) noexcept {
    const scene::TubeModel model = line_record(lights, index).model;
    return model == scene::TubeModel::linear || model == scene::TubeModel::strip ? 0 : 1;
}

scene::Float3 emission(const render_cpu::LightSet& lights, std::int32_t index, const scene::Float3& origin,
                       const scene::Float3& direction) noexcept {
    const render_cpu::LineRecord& record = line_record(lights, index);
    if (record.model != scene::TubeModel::open) return record.radiance;
    const Cylinder<float> tube{
        {to_vec(record.begin) - to_vec(origin), to_vec(record.direction), record.length}, record.radius};
    return meets_cap(tube, to_vec(direction)) ? scene::Float3{0, 0, 0} : record.radiance;
}

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

LightCode line_code(LaneCount<kernel::kLanes>) {
    return {&kernel::choose, &kernel::shape_of, &kernel::emission};
}

} // namespace nusselt::render_cpu
