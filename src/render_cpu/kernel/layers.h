#pragma once
/// The layers beside the image: sums for the pixels of a packet over their camera rays.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"
#include "render_cpu/kernel/pixel_output.h"
#include "render_cpu/kernel/surface.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// Reflected radiance.
struct Reflected {
    Vector all;
    Vector diffuse; ///< the part of the diffuse component; not meaningful without layers
};

/// The shares of a sample of direct light that belong to the diffuse component of the BRDF, per colour channel.
struct DiffuseShares {
    Vector of_sample;   ///< of DirectLightSample::shadowed
    Vector of_constant; ///< of DirectLightSample::constant
};

/// Shares that keep the estimates of both components unbiased, whichever technique the sample comes from. The
/// contribution of all techniques in a direction is proportional to the BRDF, so its components share it in the
/// proportion of their values. Constants have mean zero at each shading point, and a share that is the same for all
/// samples of the point does not change that.
/// \param wi as DirectLightSample::wi
DiffuseShares diffuse_shares(const GlossySurface<Real, SurfaceBrdf>& surface, const Vector& wi) noexcept;

/// Sums over the camera rays of one packet of pixels.
class LayerSums {
public:
    LayerSums(const render_cpu::RenderJob& job, const render_cpu::TileMemory& memory) noexcept
        : job_(job), light_sums_(memory.light_sums), kept_light_sums_(memory.kept_light_sums) {}

    /// Starts the next packet.
    void clear() noexcept;

    /// All sums but those of lights.
    struct State {
        CompensatedSum albedo, normal, emission, diffuse, specular;
        CompensatedSum depth_and_coverage; ///< in x and y
        CompensatedSum pieces;             ///< lines and their parts, in x and y
        // Statistics of the radiance of camera rays (Welford).
        float rays = 0;
        Vector mean{Real(0), Real(0), Real(0)};
        CompensatedSum square_deviations;
    };

    const State& state() const noexcept { return state_; }
    /// Goes on with a packet, and keeps its sums. \param state its state; the sums of lights are where it left them
    void resume(const State& state) noexcept;
    /// Keeps the sums of lights, so that restore() returns to them. \returns the others
    const State& keep() noexcept;
    /// Returns to the sums that were kept last. \param state what keep() returned or resume() got
    void restore(const State& state) noexcept;

    /// Starts the next camera ray. \param weight see CameraSamples
    void begin_ray(const Real& weight) noexcept { weight_ = weight; }

    /// Adds what camera rays hit. Ignores the weights of the rays, since negative weights would give impossible
    /// distances.
    /// \param any_hit   lanes that hit a surface or a light
    /// \param direction of the rays, of any length
    void add_hits(const visibility::HitPacket<kLanes>& hits, LaneMask any_hit,
                  const Vector& direction) noexcept;

    /// Adds the surfaces that camera rays hit.
    void add_surface(const Surface& surface) noexcept;

    /// Adds the radiance of lights that camera rays hit.
    /// \param origin    of the rays
    /// \param direction of the rays, of any length
    void add_emission(const visibility::HitPacket<kLanes>& hits, const Vector& emitted, const Vector& origin,
                      const Vector& direction) noexcept;

    /// Adds light that the surfaces reflect.
    /// \param number of the light among all lights of the scene
    void add_light(std::uint32_t number, const Reflected& reflected) noexcept;

    /// Adds lines of a light, and how many visible parts they have.
    void add_pieces(const Real& lines, const Real& parts) noexcept {
        state_.pieces.add({lines, parts, Real(0)});
    }

    /// Ends a camera ray. \param radiance all radiance that arrives along it, times its weight
    void add_radiance(const Vector& radiance) noexcept;

    /// Stores the means in the layers of the job.
    void write(const PixelBlock& block) const noexcept;

private:
    std::size_t light_sum_bytes() const noexcept;
    void add_to_light(std::int32_t number, int lane, const float (&rgb)[3]) noexcept;
    float* sums_of(std::uint32_t emitter) const noexcept {
        return light_sums_ + render_cpu::kLightSumFloatsPerLane * kLanes * emitter;
    }

    const render_cpu::RenderJob& job_;
    float* light_sums_; ///< a CompensatedSum for each emitter
    float* kept_light_sums_;
    Real weight_ = Real(1);
    State state_;
};

} // namespace kernel
NUSSELT_NAMESPACE_END
