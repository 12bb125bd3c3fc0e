// Discs for kernels: samples of their area in place of all techniques.

#include "disc_kernel.h"
#include "render_cpu/kernel/point_samples.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

const scene::DiscLight& disc_record(const render_cpu::LightSet& lights, std::int32_t index) noexcept {
    return static_cast<const scene::DiscLight*>(lights.records)[index];
}

/// In shading space.
struct DiscShape {
    Vector center, normal;
    Real radius;
};

/// Evenly distributed over the area; the density is that of directions.
class DiscArea {
public:
    explicit DiscArea(const DiscShape& disc) noexcept
        : disc_(disc), frame_(Frame<Real>::from_normal(disc.normal)) {}

    LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Real radius = disc_.radius * sqrt(u.x);
        // The sine and cosine of half the azimuth give those of the azimuth.
        const SinCos<Real> half = sincos_half_turn(Real(kPi<float>) * u.y);
        const Real x = radius * (Real(1) - Real(2) * half.sin * half.sin);
        const Real y = radius * (Real(2) * half.sin * half.cos);
        const Vector p = disc_.center + x * frame_.t + y * frame_.b;
        const Real distance_squared = dot(p, p);
        const Vector wi = (Real(1) / sqrt(distance_squared)) * p;
        const Real area = Real(kPi<float>) * disc_.radius * disc_.radius;
        return {wi, distance_squared / (abs(dot(disc_.normal, wi)) * area), p};
    }

private:
    DiscShape disc_;
    Frame<Real> frame_;
};

/// See point_samples.h.
struct Disc {
    using Shape = DiscShape;

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const scene::DiscLight& record = disc_record(lights, index);
        const Surface& surface = reflected.surface();
        const Vector to_center = broadcast<Real>(to_vec(record.center)) - surface.position;
        const Vector normal = broadcast<Real>(to_vec(record.normal));
        const auto is_behind = dot(normal, to_center) >= Real(0);
        return {{surface.frame.to_local(to_center), surface.frame.to_local(normal), Real(record.radius)},
                reflected.lanes() & !is_behind,
                broadcast<Real>(to_vec(record.radiance)),
                static_cast<std::uint32_t>(lights.first + index)};
    }

    template <render::Technique technique_of_job>
    static auto technique(TechniqueTag<technique_of_job>, const Shape& shape) noexcept {
        return DiscArea(shape);
    }
};

void choose(const render_cpu::RenderJob& job, render_cpu::AddLight (&add)[render_cpu::kMostShapes]) noexcept {
    add[0] = point_samples<Disc>(job);
}

std::int32_t shape_of(const render_cpu::LightSet& /*lights*/, std::int32_t /*index*/) noexcept { return 0; }

scene::Float3 emission(const render_cpu::LightSet& lights, std::int32_t index,
                       const scene::Float3& /*origin*/, const scene::Float3& direction) noexcept {
    const scene::DiscLight& light = disc_record(lights, index);
    return dot(to_vec(light.normal), to_vec(direction)) < 0 ? light.radiance : scene::Float3{0, 0, 0};
}

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

LightCode disc_code(LaneCount<kernel::kLanes>) {
    return {&kernel::choose, &kernel::shape_of, &kernel::emission};
}

} // namespace nusselt::render_cpu
