#pragma once
/// Random numbers for packets of pixels.

#include "render/choices/sampler.h"
#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"

#include <nusselt/random/light_random.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The pixels of a packet.
struct PixelBlock {
    alignas(4 * kLanes) std::uint32_t x[kLanes];
    alignas(4 * kLanes) std::uint32_t y[kLanes];
    Vec2<Real> corner; ///< x and y
    LaneMask inside;   ///< pixels inside the tile
    /// Pixels inside the film. Neighbours may change the rounding of hits, so the rays of a packet must not depend on
    /// the tile.
    LaneMask traced;
};

/// The same sample number for all pixels of a packet.
struct PacketSamples {
    explicit PacketSamples(std::uint32_t sample) noexcept {
        for (std::uint32_t& lane : number) lane = sample;
    }
    std::uint32_t number[kLanes];
};

/// The pairs of random numbers for a light.
enum RandomPair : std::uint32_t {
    kPointPair,         ///< for the only technique, or the diffuse one
    kSpecularPointPair, ///< for the specular one
    // Lines may use separate pairs for each camera ray: every second pair from here on, see random_for_lines().
    kOrientationPair,
    kLinePair,
};

/// Random numbers for one sample of one light.
/// \param sample number among all samples of the pixel
/// \param count  number of all samples of the pixel
/// \param pair   which pair of dimensions
inline Vec2<Real> random_for_light(const render_cpu::RenderJob& job, const PixelBlock& block,
                                   std::uint32_t sample, std::uint32_t count, std::uint32_t light,
                                   RandomPair pair) noexcept {
    const PacketSamples samples(sample);
    float x[kLanes];
    float y[kLanes];
    light_random_lanes(sampler_of(job.sample_order), job.seed, block.x, block.y, samples.number, count, light,
                       pair, x, y, {job.blue_noise});
    return {Real::load(x), Real::load(y)};
}

/// Random numbers for lines of one light at one shading point, with one line per lane.
/// \param lane  of the pixel in the packet
/// \param first number of the line in the first lane, among those of the shading point
/// \param pair  kOrientationPair or kLinePair
inline Vec2<Real> random_for_lines(const render_cpu::RenderJob& job, const PixelBlock& block, int lane,
                                   std::uint32_t camera_ray, std::uint32_t first, std::uint32_t light,
                                   RandomPair pair) noexcept {
    const auto per_point = static_cast<std::uint32_t>(job.lines.count);
    const Sampler sampler = sampler_of(job.sample_order);
    // Aligned blocks of Sobol' points whose size is a power of two are as evenly distributed as the whole sequence;
    // other numbers of lines are so only over all camera rays. Other samplers cover the light with the given number
    // of samples, so each shading point gets a separate set of numbers.
    const bool is_sequence =
        sampler == Sampler::sobol || sampler == Sampler::z_sobol || sampler == Sampler::independent;
    const std::uint32_t before = is_sequence ? camera_ray * per_point : 0;
    std::uint32_t x[kLanes];
    std::uint32_t y[kLanes];
    std::uint32_t number[kLanes];
    for (std::uint32_t i = 0; i < kLanes; ++i) {
        x[i] = block.x[lane];
        y[i] = block.y[lane];
        const std::uint32_t line = first + i;
        number[i] = before + (line < per_point ? line : per_point - 1);
    }
    float u_x[kLanes];
    float u_y[kLanes];
    light_random_lanes(sampler, job.seed, x, y, number, is_sequence ? job.camera_rays * per_point : per_point,
                       light, is_sequence ? pair : pair + 2 * camera_ray, u_x, u_y, {job.blue_noise});
    return {Real::load(u_x), Real::load(u_y)};
}

/// Camera rays, one for each pixel of a packet.
struct CameraSamples {
    Vec2<Real> raster; ///< position on the film [pixels]
    Real weight;       ///< of the incoming radiance; its mean is 1
};

/// Distance from the centre of the pixel along one axis, distributed like the pixel filter. It is monotone in `u`,
/// which preserves stratification. Multiplies the weight.
inline Real filtered_offset(const render_cpu::FilterAxis& filter, const Real& u, Real& weight) noexcept {
    const Real reach = Real(filter.reach);
    if (filter.cumulative == nullptr) return reach * (Real(2) * u - Real(1));
    float lanes[kLanes];
    u.store(lanes);
    std::int32_t cell[kLanes] = {};
    for (std::int32_t step = render::kFilterCells / 2; step > 0; step /= 2)
        for (int i = 0; i < kLanes; ++i) cell[i] += filter.cumulative[cell[i] + step] <= lanes[i] ? step : 0;
    float position[kLanes];
    float cell_weight[kLanes];
    for (int i = 0; i < kLanes; ++i) {
        const float below = filter.cumulative[cell[i]];
        const float part = (lanes[i] - below) / (filter.cumulative[cell[i] + 1] - below);
        position[i] = static_cast<float>(cell[i]) + part;
        cell_weight[i] = filter.weights[cell[i]];
    }
    weight = weight * Real::load(cell_weight);
    return reach * (Real(2.0f / render::kFilterCells) * Real::load(position) - Real(1));
}

/// Not inlined, because g++ does not vectorise the hashes in a large function.
[[gnu::noinline]] inline CameraSamples
camera_samples(const render_cpu::RenderJob& job, const PixelBlock& block, std::uint32_t camera_ray) noexcept {
    Vec2<Real> offset{Real(0), Real(0)};
    Real weight = Real(1);
    if (job.pixel_position != render::PixelPosition::center) {
        const PacketSamples samples(camera_ray);
        float u_x[kLanes];
        float u_y[kLanes];
        camera_random_lanes(sampler_of(job.sample_order), job.seed, block.x, block.y, samples.number, u_x,
                            u_y);
        offset = {filtered_offset(job.scene.filter_x, Real::load(u_x), weight),
                  filtered_offset(job.scene.filter_y, Real::load(u_y), weight)};
    }
    const Real half = Real(0.5f);
    return {{(half + offset.x) + block.corner.x, (half + offset.y) + block.corner.y}, weight};
}

} // namespace kernel
NUSSELT_NAMESPACE_END
