#pragma once
/// Random numbers for packets of pixels.

#include "render_cpu/kernel.h"
#include "render_cpu/kernel/lanes.h"

#include <nusselt/random/light_random.h>

NUSSELT_NAMESPACE_BEGIN
namespace kernel {

/// The pixels of a packet.
struct PixelBlock {
    alignas(4 * kLanes) std::uint32_t x[kLanes];
    alignas(4 * kLanes) std::uint32_t y[kLanes];
    LaneMask inside; ///< the tile
    LaneMask
        traced; ///< the film: what a packet holds must not depend on the tile, as neighbours in a packet may
                ///< change the rounding of a hit
};

/// The same sample of all pixels of a packet.
struct PacketSamples {
    explicit PacketSamples(std::uint32_t sample) noexcept {
        for (std::uint32_t& lane : number) lane = sample;
    }
    std::uint32_t number[kLanes];
};

inline Sampler sampler_of(render_cpu::SampleOrder order) noexcept {
    switch (order) {
    case render_cpu::SampleOrder::independent:
        return Sampler::independent;
    case render_cpu::SampleOrder::jittered:
        return Sampler::jittered;
    case render_cpu::SampleOrder::sobol:
        break;
    }
    return Sampler::sobol;
}

/// For one sample of one light.
/// \param sample number among all samples of the pixel
/// \param pair   number of the pair of dimensions
inline Vec2<Real> random_for_light(const render_cpu::RenderJob& job, const PixelBlock& block,
                                   std::uint32_t sample, std::uint32_t light, std::uint32_t pair) noexcept {
    const std::uint32_t count = job.camera_rays * job.light_samples;
    const PacketSamples samples(sample);
    float x[kLanes];
    float y[kLanes];
    light_random_lanes(sampler_of(job.sample_order), job.seed, block.x, block.y, samples.number, count, light,
                       pair, x, y);
    return {Real::load(x), Real::load(y)};
}

/// Camera rays, one for each pixel of a packet.
struct CameraSamples {
    Vec2<Real> raster; ///< position on the film [pixels]
    Real weight;       ///< of the radiance that arrives; its mean is 1
};

/// Distributes random numbers as the pixel filter wants it, in place; monotone, so that stratified ones stay that.
/// Multiplies weights.
inline void apply_filter(const render_cpu::FilterAxis& filter, float (&u)[kLanes],
                         float (&weight)[kLanes]) noexcept {
    if (filter.offsets == nullptr) {
        for (float& x : u) x = 0.5f + filter.radius * (2 * x - 1);
        return;
    }
    constexpr auto kCells = static_cast<float>(render_cpu::kFilterCells);
    for (int i = 0; i < kLanes; ++i) {
        const float position = u[i] * kCells;
        const auto cell = static_cast<std::int32_t>(position);
        const float begin = filter.offsets[cell];
        u[i] = 0.5f + (begin + (position - static_cast<float>(cell)) * (filter.offsets[cell + 1] - begin));
        weight[i] *= filter.weights[cell];
    }
}

inline CameraSamples camera_samples(const render_cpu::RenderJob& job, const PixelBlock& block,
                                    std::uint32_t camera_ray) noexcept {
    float x[kLanes];
    float y[kLanes];
    float weight[kLanes];
    for (float& lane : weight) lane = 1;
    if (job.pixel_position == render_cpu::PixelPosition::center) {
        for (int i = 0; i < kLanes; ++i) x[i] = y[i] = 0.5f;
    } else {
        const PacketSamples samples(camera_ray);
        camera_random_lanes(sampler_of(job.sample_order), job.seed, block.x, block.y, samples.number, x, y);
        apply_filter(job.scene.filter_x, x, weight);
        apply_filter(job.scene.filter_y, y, weight);
    }
    for (int i = 0; i < kLanes; ++i) {
        x[i] += static_cast<float>(static_cast<std::int32_t>(block.x[i]));
        y[i] += static_cast<float>(static_cast<std::int32_t>(block.y[i]));
    }
    return {{Real::load(x), Real::load(y)}, Real::load(weight)};
}

} // namespace kernel
NUSSELT_NAMESPACE_END
