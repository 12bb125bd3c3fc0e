#pragma once
/// Portals of environments with room for N vertices.

#include "render_cpu/kernel/lights/environment_light.h"
#include "render_cpu/kernel/lights/stored_polygon.h"
#include "render_cpu/kernel/reflected_light.h"
#include "render_cpu/kernel/single_lane.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// A portal in shading space.
template <int N>
struct LocalPortal : ConvexPolygon<Real, N> {
    const render_cpu::EnvironmentRecord* environment;
    float distance; ///< beyond the scene, from any of its points [m]

    /// Multiplies a sample by the radiance in its direction, and moves its end to where this comes from.
    void modulate(const Surface& surface, DirectLightSample<Real>& sample) const noexcept {
        sample.p = Real(distance) * sample.wi;
        if (environment->map == nullptr) return;
        Lanes radiance;
        for (int i = 0; i < kLanes; ++i) {
            const auto wi = single_lane<Vec3<float>>(sample.wi, i);
            const Vec3<float> value =
                radiance_towards(*environment, single_lane<Frame<float>>(surface.frame, i).to_world(wi));
            radiance.x[i] = value.x;
            radiance.y[i] = value.y;
            radiance.z[i] = value.z;
        }
        sample.shadowed = load(radiance) * sample.shadowed;
    }
};

/// A kind of light as point_samples.h describes it. Light passes both ways.
template <int N>
struct PortalLight : PolygonTechniques<N> {
    using Shape = LocalPortal<N>;

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const render_cpu::EnvironmentRecord& record = environment_record(lights, index);
        const Surface& surface = reflected.surface();
        const auto local = to_shading_space(stored_polygon<N>(record.corners, record.normal),
                                            surface.position, surface.frame);
        // Comparisons with NaN are false. Negated, they keep NaN, so that it is counted.
        const LaneMask lit = reflected.lanes() & !(highest_vertex(local) <= Real(0));
        const Vector white{Real(1), Real(1), Real(1)};
        return {{local, &record, 4 * reflected.job().scene.radius},
                lit,
                record.map == nullptr ? broadcast<Real>(to_vec(record.radiance)) : white,
                static_cast<std::uint32_t>(lights.first + index)};
    }
};

/// The function that takes points of portals as if the radiance behind them were the same everywhere.
template <int N>
render_cpu::AddLight portal_points(const render_cpu::RenderJob& job) noexcept;

template <>
render_cpu::AddLight portal_points<4>(const render_cpu::RenderJob& job) noexcept;
template <>
render_cpu::AddLight portal_points<8>(const render_cpu::RenderJob& job) noexcept;

} // namespace kernel
NUSSELT_NAMESPACE_END
