// Environments: light from infinity in all directions, or in those that a portal lets through.

#include "render_cpu/kernel/lights/cell_samples.h"
#include "render_cpu/kernel/lights/portal_light.h"
#include "render_cpu/kernel/lights/window_samples.h"

#include <nusselt/emission/environment_sampling.h>
#include <nusselt/emission/windowed_polygon.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

using DiffuseCells = EnvironmentCosine<Real, render_cpu::kEnvironmentCells>;
using SpecularCells = EnvironmentLtc<Real, render_cpu::kEnvironmentCells>;

/// All directions. Shadow rays end beyond the scene, from any of its points.
struct Sky {
    float distance;

    Vector point(const Vector& wi) const noexcept { return Real(distance) * wi; }
};

/// Sampling of the hemisphere by the cosine.
struct CosineOfSky {
    Sky sky;

    LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vector wi = sample_cosine(u);
        return {wi, pdf(wi), sky.point(wi)};
    }
    Real pdf(const Vector& wi) const noexcept { return Real(1 / kPi<float>) * max(wi.z, Real(0)); }
    Real measure() const noexcept { return Real(kPi<float>); }

    static Vector sample_cosine(const Vec2<Real>& u) noexcept {
        const Real radius = sqrt(u.x);
        const SinCos<Real> angle = sincos_full_turn(u.y);
        return {radius * angle.cos, radius * angle.sin, sqrt(max(Real(1) - u.x, Real(0)))};
    }
    static SinCos<Real> sincos_full_turn(const Real& turns) noexcept {
        const auto second = turns >= Real(0.5f);
        const SinCos<Real> half =
            sincos_half_turn(Real(2 * kPi<float>) * (turns - select(second, Real(0.5f), Real(0))));
        return {select(second, -half.sin, half.sin), select(second, -half.cos, half.cos)};
    }
};

/// Sampling of a lobe, also below the horizon.
struct LobeOfSky {
    Sky sky;
    Ltc<Real> lobe;

    LightSample<Real> sample(const Vec2<Real>& u) const noexcept {
        const Vector wi = normalize(lobe.to_shading(CosineOfSky::sample_cosine(u)));
        return {wi, pdf(wi), sky.point(wi)};
    }
    Real pdf(const Vector& wi) const noexcept { return lobe.density(wi); }
    Real measure() const noexcept { return Real(1); }
};

/// The techniques for the same radiance everywhere.
struct SkyPair : CosineMeasures {
    template <class AnySurface>
    static CosineOfSky diffuse(const Sky& sky, const AnySurface& /*surface*/) noexcept {
        return {sky};
    }
    template <class AnySurface>
    static LobeOfSky specular(const Sky& sky, const AnySurface& surface) noexcept {
        return {sky, surface.lobe};
    }
};

LocalLight<Sky> local_sky(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                          std::int32_t index, const Vector& emission) noexcept {
    return {{4 * reflected.job().scene.radius},
            reflected.lanes(),
            emission,
            static_cast<std::uint32_t>(lights.first + index)};
}

struct UniformSky {
    using Shape = Sky;

    static LocalLight<Sky> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                 std::int32_t index) noexcept {
        return local_sky(reflected, lights, index,
                         broadcast<Real>(to_vec(environment_record(lights, index).radiance)));
    }
};

void add_uniform_by_cosine(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                           std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = UniformSky::local(reflected, lights, index);
    add_samples(reflected, light, CosineOfSky{light.shape});
}

/// The part of the lobe below the horizon counts, too.
void add_uniform_analytically(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                              std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = UniformSky::local(reflected, lights, index);
    const auto& surface = reflected.surface().glossy;
    reflected.add_known(light, {surface.diffuse_albedo + surface.specular_albedo, surface.diffuse_albedo});
}

/// A sky with a map as a packet of shading points sees it, see cell_samples.h.
class SkyCells {
public:
    SkyCells(const render_cpu::EnvironmentRecord& record, const Surface& surface, float distance) noexcept
        : map_(map_of(record)),
          frame_{to_map(record, surface.frame.t), to_map(record, surface.frame.b),
                 to_map(record, surface.frame.n)},
          distance_(distance) {}

    PackTechnique<DiffuseCells> diffuse(LaneMask lanes) const noexcept {
        return {lanes, DiffuseCells(map_, frame_)};
    }
    PackTechnique<SpecularCells> specular(LaneMask lanes, const Ltc<Real>& lobe) const noexcept {
        return {lanes, SpecularCells(map_, frame_, {lobe})};
    }
    Vector radiance(const TexturedSample<Real>& sample) const noexcept {
        Lanes result;
        float x[kLanes], y[kLanes];
        sample.at.x.store(x);
        sample.at.y.store(y);
        for (int lane = 0; lane < kLanes; ++lane) {
            const Vec3<float> value = map_.radiance.lookup(Vec2<float>{x[lane], y[lane]});
            result.x[lane] = value.x;
            result.y[lane] = value.y;
            result.z[lane] = value.z;
        }
        return load(result);
    }
    Vector point(const TexturedSample<Real>& sample) const noexcept { return Real(distance_) * sample.wi; }
    template <class Technique>
    Real density(const Technique& technique, const TexturedSample<Real>& sample) const noexcept {
        return technique.pdf_at(sample.at);
    }

private:
    const SkyMap& map_;
    Frame<Real> frame_;
    float distance_; ///< beyond the scene, from any of its points [m]
};

/// A sky behind a portal, see cell_samples.h.
class PortalCells {
public:
    using Diffuse = WindowedPolygon<float, render_cpu::kEnvironmentCells>;
    using Specular = WindowedPolygonLtc<float, render_cpu::kEnvironmentCells>;

    PortalCells(const render_cpu::EnvironmentRecord& record, const Surface& surface, float distance) noexcept
        : record_(record), surface_(surface), distance_(distance) {
        const Vector to_portal = broadcast<Real>(side(0).plane.corner) - surface.position;
        behind_ = (dot(broadcast<Real>(side(0).plane.frame.n), to_portal) > Real(0)).bits();
    }
    /// The normal of a portal leads away from the points that it is for.
    const WindowedLight<float>& light(int lane) const noexcept {
        return side((behind_ >> lane & 1u) != 0 ? 0 : 1);
    }

    LaneTechniques<Diffuse> diffuse(LaneMask lanes) const noexcept {
        return {lanes, [&](int lane) { return Diffuse(plane(lane), light(lane)); }};
    }
    LaneTechniques<Specular> specular(LaneMask lanes, const Ltc<Real>& lobe) const noexcept {
        return {lanes, [&](int lane) {
                    return Specular(plane(lane), light(lane), {single_lane<Ltc<float>>(lobe, lane)});
                }};
    }
    Vec3<float> radiance(const WindowSample<float>& sample, int lane) const noexcept {
        return radiance_towards(record_, single_lane<Frame<float>>(surface_.frame, lane).to_world(sample.wi));
    }
    Vec3<float> point(const WindowSample<float>& sample) const noexcept { return distance_ * sample.wi; }
    template <class Technique>
    float density(const Technique& technique, const WindowSample<float>& sample) const noexcept {
        return technique.pdf(sample.wi);
    }

private:
    const WindowedLight<float>& side(int k) const noexcept {
        return *static_cast<const WindowedLight<float>*>(record_.portal[k]);
    }
    WindowPlane<float> plane(int lane) const noexcept {
        return to_shading_space(light(lane).plane, single_lane<Vec3<float>>(surface_.position, lane),
                                single_lane<Frame<float>>(surface_.frame, lane));
    }

    const render_cpu::EnvironmentRecord& record_;
    const Surface& surface_;
    float distance_;       ///< beyond the scene, from any of its points [m]
    std::uint32_t behind_; ///< a bit for each lane
};

template <void (*add)(ReflectedLight&, const PortalCells&, const LocalLight<Sky>&) noexcept>
void add_through_portal(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                        std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = local_sky(reflected, lights, index, {Real(1), Real(1), Real(1)});
    if (!any(light.lit)) return;
    add(reflected, PortalCells(environment_record(lights, index), reflected.surface(), light.shape.distance),
        light);
}

/// Samples from cells where the map varies over the portal, which find a sun. Elsewhere they would cost much and gain little.
template <int N, void (*add)(ReflectedLight&, const PortalCells&, const LocalLight<Sky>&) noexcept>
void add_portal_samples(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                        std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    const auto light = PortalLight<N>::local(reflected, lights, index);
    if (!any(light.lit)) return;
    const PortalCells cells(*light.shape.environment, reflected.surface(), light.shape.distance);
    const LaneMask even = varies_little(
        light.lit, reflected.surface(), [&](int lane) -> const auto& { return cells.light(lane); });
    add_where_it_varies(
        reflected, light.lit, even,
        [&](ReflectedLight& part) { add_through_portal<add>(part, lights, index); },
        [&](ReflectedLight& part) { portal_points<N>(reflected.job())(part, lights, index); });
}

template <void (*add)(ReflectedLight&, const SkyCells&, const LocalLight<Sky>&) noexcept>
void add_mapped(render_cpu::LitPacket& packet, const render_cpu::LightSet& lights,
                std::int32_t index) noexcept {
    auto& reflected = static_cast<ReflectedLight&>(packet);
    // The radiance is part of each sample.
    const auto light = local_sky(reflected, lights, index, {Real(1), Real(1), Real(1)});
    if (!any(light.lit)) return;
    add(reflected, SkyCells(environment_record(lights, index), reflected.surface(), light.shape.distance),
        light);
}

template <int N>
render_cpu::AddLight mapped_portal(const render_cpu::RenderJob& job) noexcept {
    if (job.technique == render::Technique::ltc_analytic) return &add_through_portal<&add_cell_integrals>;
    if (takes_windowed_products(job)) {
        if (job.strategies == render::Strategies::diffuse) return &add_portal_samples<N, &add_by_cells>;
        if (job.strategies == render::Strategies::diffuse_ltc)
            return &add_portal_samples<N, &add_by_cell_pair>;
    }
    return portal_points<N>(job);
}

void choose(const render_cpu::RenderJob& job, render_cpu::AddLight (&add)[render_cpu::kMostShapes]) noexcept {
    if (job.technique == render::Technique::ltc_analytic) {
        add[0] = &add_uniform_analytically;
        add[1] = &add_mapped<&add_cell_integrals>;
    } else if (job.strategies == render::Strategies::diffuse_ltc) {
        add[0] = &add_by_pair<UniformSky, SkyPair>;
        add[1] = &add_mapped<&add_by_cell_pair>;
    } else {
        add[0] = &add_uniform_by_cosine;
        add[1] = &add_mapped<&add_by_cells>;
    }
    add[2] = portal_points<4>(job);
    add[3] = portal_points<8>(job);
    add[4] = mapped_portal<4>(job);
    add[5] = mapped_portal<8>(job);
}

std::int32_t shape_of(const render_cpu::LightSet& lights, std::int32_t index) noexcept {
    const render_cpu::EnvironmentRecord& record = environment_record(lights, index);
    const bool has_map = record.map != nullptr;
    if (record.slots == 0) return has_map ? 1 : 0;
    return (record.slots == 4 ? 2 : 3) + (has_map ? 2 : 0);
}

/// Rays do not hit it.
scene::Float3 emission(const render_cpu::LightSet& /*lights*/, std::int32_t /*index*/,
                       const scene::Float3& /*origin*/, const scene::Float3& /*direction*/) noexcept {
    return {0, 0, 0};
}

/// Whether a ray leaves through a portal.
bool leaves_through(const render_cpu::EnvironmentRecord& record, const Vec3<float>& origin,
                    const Vec3<float>& direction) noexcept {
    const Vec3<float> normal = to_vec(record.normal);
    const float along = dot(normal, direction);
    if (!(dot(normal, to_vec(record.corners[0]) - origin) * along > 0)) return false;
    // Edges wind around the ray, all in the same sense.
    for (std::int32_t k = 0; k < record.slots; ++k) {
        const Vec3<float> edge = to_vec(record.corners[record.slots + k]);
        const Vec3<float> moment = cross(to_vec(record.corners[k]) - origin, edge);
        if (!(dot(direction, moment) * along >= 0)) return false;
    }
    return true;
}

scene::Float3 background(const render_cpu::LightSet& lights, std::int32_t index, const scene::Float3& origin,
                         const scene::Float3& direction) noexcept {
    const render_cpu::EnvironmentRecord& record = environment_record(lights, index);
    if (record.slots > 0 && !leaves_through(record, to_vec(origin), to_vec(direction))) return {0, 0, 0};
    const Vec3<float> radiance = radiance_towards(record, normalize(to_vec(direction)));
    return {radiance.x, radiance.y, radiance.z};
}

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

LightCode environment_code(LaneCount<kernel::kLanes>) {
    return {&kernel::choose, &kernel::shape_of, &kernel::emission, &kernel::background};
}

} // namespace nusselt::render_cpu
