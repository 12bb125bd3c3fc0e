#pragma once
/// Direct light at a packet of shading points: the code that all ways to estimate it share.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/layers.h"
#include "render_cpu/kernel/random.h"
#include "render_cpu/kernel/stop_request.h"
#include "render_cpu/kernel/surface.h"
#include "render_cpu/kernel/tick_timer.h"

#include <nusselt/estimate/direct_light.h>
#include <nusselt/line_samples/triangle_shadow.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The lanes in which all components are finite.
inline LaneMask is_finite(const Vector& v) noexcept {
    return is_finite(v.x) & is_finite(v.y) & is_finite(v.z);
}

/// A light as a packet of shading points sees it.
template <class Shape>
struct LocalLight {
    Shape shape;          ///< in shading space, per lane
    LaneMask lit;         ///< points that it may light
    Vector emission;      ///< radiance; for thin lines, radiance times radius
    std::uint32_t number; ///< among all lights of the scene
};

/// Dims a sample to what the light emits at its point. A shape whose radiance is not the same everywhere does so by a member
/// `modulate`; a sample that meets a dark part counts like one in shadow.
template <class Shape>
void modulate(const Shape& shape, const Surface& surface, DirectLightSample<Real>& sample) noexcept {
    if constexpr (requires { shape.modulate(surface, sample); }) shape.modulate(surface, sample);
}

/// The sum of the samples of one light.
struct SampleSum {
    CompensatedSum all;
    CompensatedSum diffuse; ///< the part of the diffuse component, if the job has layers
};

/// The light that one packet of shading points reflects to the eye.
class ReflectedLight : public render_cpu::LitPacket {
public:
    /// \param camera_ray  number of the camera rays of this packet, below job.camera_rays
    /// \param layers      to add the light to, or null
    /// \param line_memory see TileMemory
    /// \param stop        see CameraPacket
    ReflectedLight(const render_cpu::RenderJob& job, const PixelBlock& block, const Surface& surface,
                   std::uint32_t camera_ray, LayerSums* layers, void* line_memory, const StopRequest& stop,
                   render_cpu::TileStatistics& statistics) noexcept
        : job_(job),
          block_(block),
          surface_(surface),
          camera_ray_(camera_ray),
          lanes_(surface.valid),
          samples_per_light_(job.samples_per_light),
          layers_(layers),
          line_memory_(line_memory),
          stop_(stop),
          statistics_(statistics) {}

    const render_cpu::RenderJob& job() const noexcept { return job_; }
    const Surface& surface() const noexcept { return surface_; }
    /// The shading points that get light.
    LaneMask lanes() const noexcept { return lanes_; }

    render_cpu::TileStatistics& statistics() noexcept { return statistics_; }
    void* line_memory() const noexcept { return line_memory_; }
    const StopRequest& stop() const noexcept { return stop_; }

    /// The same object for some of the shading points and another number of samples per light. It shares the layers
    /// and the statistics; its radiance starts at 0 and is for add().
    ReflectedLight with(LaneMask lanes, std::uint32_t samples_per_light) const noexcept {
        ReflectedLight result = *this;
        result.lanes_ &= lanes;
        result.samples_per_light_ = samples_per_light;
        result.radiance_ = {Real(0), Real(0), Real(0)};
        return result;
    }

    /// Adds the radiance of an object that with() made.
    void add(const ReflectedLight& other) noexcept { radiance_ = radiance_ + other.radiance_; }

    /// The shading points that lie on a light. \param number of the light among all lights of the scene
    LaneMask on_light(std::int32_t number) const noexcept {
        std::uint32_t bits = 0;
        for (int i = 0; i < kLanes; ++i)
            bits |= static_cast<std::uint32_t>(surface_.light.lane[i] == number) << i;
        return LaneMask::from_bits(bits);
    }

    /// Adds the reflected radiance of one light [W/(sr m^2)], which is the mean over its samples.
    /// \param sample takes a sample number and adds samples of the light with add_sample()
    template <class Shape, class Sample>
    void add(const LocalLight<Shape>& light, const Sample& sample) noexcept {
        SampleSum sum;
        const std::uint32_t first = camera_ray_ * samples_per_light_;
        for (std::uint32_t i = 0; i < samples_per_light_; ++i) {
            if (i % kSamplesBetweenChecks == kSamplesBetweenChecks - 1 && stop_.is_urgent()) return;
            sample(first + i, sum);
        }
        const Real scale(1.0f / static_cast<float>(samples_per_light_));
        add_for(light, light.lit, scale * light.emission, {sum.all.sum, sum.diffuse.sum});
    }

    /// Adds reflected radiance that is known without samples.
    /// \param reflected for an emission of 1
    template <class Shape>
    void add_known(const LocalLight<Shape>& light, const Reflected& reflected) noexcept {
        const LaneMask sound = is_finite(reflected.all);
        statistics_.rejected_samples += count_lanes(light.lit & !sound);
        add_for(light, light.lit & sound, light.emission, reflected);
    }

    /// Adds the numbers of lines and visible parts of a light.
    /// \param lines number of lines that were taken
    /// \param parts number of their visible parts
    void add_pieces(const Real& lines, const Real& parts) noexcept {
        if (layers_ != nullptr) layers_->add_pieces(lines, parts);
    }

    /// Random numbers for one sample of a light.
    /// \param pair the pair of the technique
    template <class Shape>
    Vec2<Real> random(const LocalLight<Shape>& light, std::uint32_t sample, RandomPair pair) const noexcept {
        return random_for_light(job_, block_, sample, job_.camera_rays * samples_per_light_, light.number,
                                pair);
    }

    /// Random numbers that all lines of a light at a shading point share.
    Vec2<Real> orientation_random(std::int32_t light) const noexcept {
        return random_for_light(job_, block_, camera_ray_, job_.camera_rays,
                                static_cast<std::uint32_t>(light), kOrientationPair);
    }

    /// \copydoc random_for_lines
    Vec2<Real> line_random(std::int32_t light, int lane, std::uint32_t first,
                           RandomPair pair) const noexcept {
        return random_for_lines(job_, block_, lane, camera_ray_, first, static_cast<std::uint32_t>(light),
                                pair);
    }

    /// Traces shadow rays for a sample and adds its contribution.
    /// \param drawn lanes that have a sample
    template <class Shape>
    void add_sample(const Shape& shape, LaneMask drawn, DirectLightSample<Real> sample,
                    SampleSum& sum) noexcept {
        modulate(shape, surface_, sample);
        add_sample(drawn, sample, sum);
    }

    const Vector& radiance() const noexcept { return radiance_; }

private:
    /// About a millisecond.
    static constexpr std::uint32_t kSamplesBetweenChecks = 1024;

    void add_sample(LaneMask drawn, const DirectLightSample<Real>& sample, SampleSum& sum) noexcept {
        const auto is_zero = [](const Vector& v) {
            return (v.x == Real(0)) & (v.y == Real(0)) & (v.z == Real(0));
        };
        // Direction and point have no meaning without a density.
        const LaneMask has_way = is_zero(sample.shadowed) | (is_finite(sample.wi) & is_finite(sample.p));
        const LaneMask sound = has_way & is_finite(sample.shadowed) & is_finite(sample.constant);
        statistics_.rejected_samples += count_lanes(drawn & !sound);
        const Vector zero{Real(0), Real(0), Real(0)};
        const Vector lit = select(visible(drawn & sound, sample), sample.shadowed, zero);
        const Vector constant = select(drawn & sound, sample.constant, zero);
        sum.all.add(lit + constant);
        if (layers_ == nullptr) return;
        const DiffuseShares shares = diffuse_shares(surface_.glossy, sample.wi);
        sum.diffuse.add(shares.of_sample * lit + shares.of_constant * constant);
    }

    template <class Shape>
    void add_for(const LocalLight<Shape>& light, LaneMask lit, const Vector& emission,
                 const Reflected& reflected) noexcept {
        const Vector zero{Real(0), Real(0), Real(0)};
        const Vector radiance = select(lit, emission * reflected.all, zero);
        radiance_ = radiance_ + radiance;
        if (layers_ == nullptr) return;
        const Vector diffuse = select(lit, emission * reflected.diffuse, zero);
        layers_->add_light(light.number, {radiance, diffuse});
    }

    /// The lanes whose sample contributes and is not in shadow.
    LaneMask visible(LaneMask sampled, const DirectLightSample<Real>& sample) noexcept {
        const Vector to_light = surface_.frame.to_world(sample.p);
        const auto above_surface = dot(surface_.geometric_normal, to_light) > Real(0);
        const Vector& reflected = sample.shadowed;
        const Real largest = max(max(reflected.x, reflected.y), reflected.z);
        const LaneMask needed = sampled & above_surface & (largest > Real(0));
        const std::uint32_t active = needed.bits();
        if (active == 0) return needed;

        const Vector offset = surface_.offset * surface_.geometric_normal;
        const Vector origin = surface_.position + offset;
        const Vector direction = to_light - offset;
        visibility::RayPacket<kLanes> rays;
        origin.x.store(rays.origin[0]);
        origin.y.store(rays.origin[1]);
        origin.z.store(rays.origin[2]);
        direction.x.store(rays.direction[0]);
        direction.y.store(rays.direction[1]);
        direction.z.store(rays.direction[2]);
        Real(kShadowEnd<float>).store(rays.t_far);
        const visibility::PacketTracer<kLanes>& tracer = job_.tracer;
        statistics_.shadow_rays += count_lanes(needed);
        const TickTimer timer(statistics_.shadow_ticks);
        const std::uint32_t blocked = tracer.occluded(job_.tracer.context, active, rays);
        return LaneMask::from_bits(active & ~blocked);
    }

    const render_cpu::RenderJob& job_;
    const PixelBlock& block_;
    const Surface& surface_;
    std::uint32_t camera_ray_;
    LaneMask lanes_; ///< shading points that get light
    std::uint32_t samples_per_light_;
    LayerSums* layers_;
    void* line_memory_;
    const StopRequest& stop_;
    render_cpu::TileStatistics& statistics_;
    Vector radiance_{Real(0), Real(0), Real(0)};
};

/// The contribution of a sample of a light through all components of the BRDF.
inline DirectLightSample<Real> reflect(const Surface& surface, const LightSample<Real>& sample) noexcept {
    // Comparisons with NaN are false. Negated, they keep NaN, so that it is counted.
    const LaneMask sampled = !((sample.pdf == Real(0)) | (sample.wi.z <= Real(0)));
    const Vector zero{Real(0), Real(0), Real(0)};
    const Real cos_per_pdf = sample.wi.z / select(sampled, sample.pdf, Real(1));
    return {sample.wi, sample.p, select(sampled, cos_per_pdf * surface.glossy.brdf.eval(sample.wi), zero),
            zero};
}

} // namespace kernel
NUSSELT_NAMESPACE_END
