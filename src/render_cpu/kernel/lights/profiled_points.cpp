// Points on polygons with a profile.

#include "render_cpu/kernel/lights/cell_samples.h"
#include "render_cpu/kernel/lights/polygon_light.h"
#include "render_cpu/kernel/lights/window_samples.h"

#include <nusselt/emission/windowed_polygon.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

/// \param back 1 for the side of the back, 0 for that of the front
const WindowedLight<float>& side_of(const render_cpu::PolygonProfile& profile, std::uint32_t back) noexcept {
    return *static_cast<const WindowedLight<float>*>(profile.side[back]);
}

/// A light with a profile as a packet of shading points sees it, see cell_samples.h. Radiance is relative to its mean.
/// \tparam n columns and rows of the lattice of cells
template <int n>
class ProfileCells {
public:
    using DiffuseCells = WindowedPolygon<float, n>;
    using SpecularCells = WindowedPolygonLtc<float, n>;

    /// \param is_behind lanes that see the back of the light
    ProfileCells(const render_cpu::PolygonProfile& profile, const Surface& surface,
                 LaneMask is_behind) noexcept
        : profile_(profile),
          surface_(surface),
          axes_(local_axes(profile, surface)),
          is_behind_(is_behind.bits()) {}

    LaneTechniques<DiffuseCells> diffuse(LaneMask lanes) const noexcept {
        return {lanes, [&](int lane) { return DiffuseCells(plane(lane), side(lane)); }};
    }
    LaneTechniques<SpecularCells> specular(LaneMask lanes, const Ltc<Real>& lobe) const noexcept {
        return {lanes, [&](int lane) {
                    return SpecularCells(plane(lane), side(lane), {single_lane<Ltc<float>>(lobe, lane)});
                }};
    }
    Vec3<float> radiance(const WindowSample<float>& sample, int lane) const noexcept {
        const float value =
            relative_radiance(profile_, single_lane<ProfileAxes<float>>(axes_, lane), -sample.wi);
        return {value, value, value};
    }
    Vec3<float> point(const WindowSample<float>& sample) const noexcept { return sample.p; }
    template <class Technique>
    float density(const Technique& technique, const WindowSample<float>& sample) const noexcept {
        return technique.pdf(sample.wi);
    }

private:
    const WindowedLight<float>& side(int lane) const noexcept {
        return side_of(profile_, is_behind_ >> lane & 1u);
    }
    WindowPlane<float> plane(int lane) const noexcept {
        return to_shading_space(side(lane).plane, single_lane<Vec3<float>>(surface_.position, lane),
                                single_lane<Frame<float>>(surface_.frame, lane));
    }

    const render_cpu::PolygonProfile& profile_;
    const Surface& surface_;
    ProfileAxes<Real> axes_;
    std::uint32_t is_behind_;
};

template <int N>
using WithoutProfile = LocalLight<ConvexPolygon<Real, N>>;

// What to do with the cells of a light. Few of them are enough for samples of luminaires, but closed-form shading takes the mean
// of each.
struct AddByCells {
    static constexpr int kLuminaireCells = 4;
    template <class Cells, class Light>
    static void add(ReflectedLight& reflected, const Cells& cells, const Light& light) noexcept {
        add_by_cells(reflected, cells, light);
    }
};
struct AddByCellPair {
    static constexpr int kLuminaireCells = 4;
    template <class Cells, class Light>
    static void add(ReflectedLight& reflected, const Cells& cells, const Light& light) noexcept {
        add_by_cell_pair(reflected, cells, light);
    }
};
struct AddCellIntegrals {
    static constexpr int kLuminaireCells = 8;
    template <class Cells, class Light>
    static void add(ReflectedLight& reflected, const Cells& cells, const Light& light) noexcept {
        add_cell_integrals(reflected, cells, light);
    }
};

/// Whether a spread or a honeycomb is in front of the light, which falls to zero within its window.
bool has_cutoff(const render_cpu::PolygonProfile& profile) noexcept {
    return profile.inverse_slope > 0 || profile.inverse_holes.x > 0 || profile.inverse_holes.y > 0;
}

/// Points that see the back of a light.
template <int N>
LaneMask is_behind(const LocalLight<LocalPolygon<N>>& light) noexcept {
    return light.lit & (dot(light.shape.normal, light.shape.vertex[0]) >= Real(0));
}

template <int N, class Add>
void add_by_profile(ReflectedLight& reflected, const render_cpu::LightSet& lights,
                    std::int32_t index) noexcept {
    const auto light = PolygonLight<N>::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const render_cpu::PolygonProfile& profile = *light.shape.profile;
    const WithoutProfile<N> plain{light.shape, light.lit, light.emission, light.number};
    if (has_cutoff(profile))
        Add::add(reflected, ProfileCells<8>(profile, reflected.surface(), is_behind(light)), plain);
    else
        Add::add(reflected,
                 ProfileCells<Add::kLuminaireCells>(profile, reflected.surface(), is_behind(light)), plain);
}

template <int N, class Add>
void add_profiled(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                  std::int32_t index) noexcept {
    add_by_profile<N, Add>(static_cast<ReflectedLight&>(packet), lights, index);
}

/// Samples from cells where the profile varies over the light. Elsewhere they would cost much and gain little.
template <int N, class Add>
void add_profiled_samples(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                          std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = PolygonLight<N>::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const std::uint32_t behind = is_behind(light).bits();
    const LaneMask even = varies_little(
        light.lit, reflected.surface(), [&](int lane) -> const auto& {
            return side_of(*light.shape.profile, behind >> lane & 1u);
        });
    add_where_it_varies(
        reflected, light.lit, even,
        [&](ReflectedLight& part) { add_by_profile<N, Add>(part, lights, index); },
        [&](ReflectedLight& part) { polygon_points<N>(reflected.job())(part, lights, index); });
}

template <int N>
render_cpu::AddLight choose_technique(const render_cpu::RenderJob& job) noexcept {
    using render::Strategies;
    if (job.technique == render::Technique::ltc_analytic) return &add_profiled<N, AddCellIntegrals>;
    if (takes_windowed_products(job)) {
        if (job.strategies == Strategies::diffuse) return &add_profiled_samples<N, AddByCells>;
        if (job.strategies == Strategies::diffuse_ltc) return &add_profiled_samples<N, AddByCellPair>;
    }
    return polygon_points<N>(job);
}

} // namespace

template <>
render_cpu::AddLight profiled_points<4>(const render_cpu::RenderJob& job) noexcept {
    return choose_technique<4>(job);
}
template <>
render_cpu::AddLight profiled_points<8>(const render_cpu::RenderJob& job) noexcept {
    return choose_technique<8>(job);
}

} // namespace kernel
NUSSELT_NAMESPACE_END
