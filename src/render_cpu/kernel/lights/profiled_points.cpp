// Points on polygons with a profile.

#include "render_cpu/kernel/lights/cell_samples.h"
#include "render_cpu/kernel/lights/polygon_light.h"

#include <nusselt/emission/windowed_polygon.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

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
        return *static_cast<const WindowedLight<float>*>(profile_.side[is_behind_ >> lane & 1u]);
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

/// How fast a spread or a honeycomb falls off with the slope of directions; 0 without either.
float steepest_slope(const render_cpu::PolygonProfile& profile) noexcept {
    return max(profile.inverse_slope, max(profile.inverse_holes.x, profile.inverse_holes.y));
}

template <int N, class Add>
void add_by_profile(ReflectedLight& reflected, const render_cpu::LightSet& lights,
                    std::int32_t index) noexcept {
    const auto light = PolygonLight<N>::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const LaneMask is_behind = light.lit & (dot(light.shape.normal, light.shape.vertex[0]) >= Real(0));
    const render_cpu::PolygonProfile& profile = *light.shape.profile;
    const WithoutProfile<N> plain{light.shape, light.lit, light.emission, light.number};
    // A spread or a honeycomb falls to zero within its window.
    if (steepest_slope(profile) == 0)
        Add::add(reflected, ProfileCells<Add::kLuminaireCells>(profile, reflected.surface(), is_behind),
                 plain);
    else
        Add::add(reflected, ProfileCells<8>(profile, reflected.surface(), is_behind), plain);
}

template <int N, class Add>
void add_profiled(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                  std::int32_t index) noexcept {
    add_by_profile<N, Add>(static_cast<ReflectedLight&>(packet), lights, index);
}

/// Points from which the profile hardly varies over the light: all of it is in a few degrees, or in a part of the spread.
template <int N>
LaneMask sees_few_directions(const LocalPolygon<N>& shape) noexcept {
    constexpr float kFewDirections = 0.15f;
    const float largest = kFewDirections / max(steepest_slope(*shape.profile), 1.0f);
    Real nearest = dot(shape.vertex[0], shape.vertex[0]);
    Real longest = dot(shape.edge[0], shape.edge[0]);
    for (int j = 1; j < N; ++j) {
        nearest = min(nearest, dot(shape.vertex[j], shape.vertex[j]));
        longest = max(longest, dot(shape.edge[j], shape.edge[j]));
    }
    return longest < Real(largest * largest) * nearest;
}

/// Samples from cells where the profile varies over the light. Elsewhere they would cost much and gain little.
template <int N, class Add>
void add_profiled_samples(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                          std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = PolygonLight<N>::local(reflected, lights, index);
    const LaneMask is_far = light.lit & sees_few_directions(light.shape);
    const LaneMask is_near = light.lit & !is_far;
    const render_cpu::RenderJob& job = reflected.job();
    if (any(is_near)) {
        ReflectedLight part = reflected.with(is_near, job.samples_per_light);
        add_by_profile<N, Add>(part, lights, index);
        reflected.add(part);
    }
    if (any(is_far)) {
        ReflectedLight part = reflected.with(is_far, job.samples_per_light);
        polygon_points<N>(job)(part, lights, index);
        reflected.add(part);
    }
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
