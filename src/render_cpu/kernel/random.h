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
};

/// \param pair_for returns the two numbers for the pixel (x, y)
template <class PairFor>
inline Vec2<Real> random_pairs(const PixelBlock& block, PairFor pair_for) noexcept {
    float x[kLanes];
    float y[kLanes];
    for (int i = 0; i < kLanes; ++i) {
        const Vec2<float> u = pair_for(block.x[i], block.y[i]);
        x[i] = u.x;
        y[i] = u.y;
    }
    return {Real::load(x), Real::load(y)};
}

/// Calls function with the Sampler as a compile-time constant: the compiler vectorises loops over lanes only
/// if they do not branch on it.
template <class Function>
inline Vec2<Real> with_sampler(render_cpu::SampleOrder order, Function function) noexcept {
    switch (order) {
    case render_cpu::SampleOrder::independent:
        return function(std::integral_constant<Sampler, Sampler::independent>());
    case render_cpu::SampleOrder::jittered:
        return function(std::integral_constant<Sampler, Sampler::jittered>());
    case render_cpu::SampleOrder::sobol:
        break;
    }
    return function(std::integral_constant<Sampler, Sampler::sobol>());
}

/// For one sample of one light.
/// \param sample number among all samples of the pixel
inline Vec2<Real> random_for_light(const render_cpu::RenderJob& job, const PixelBlock& block,
                                   std::uint32_t sample, std::uint32_t light) noexcept {
    const std::uint32_t count = job.camera_rays * job.light_samples;
    return with_sampler(job.sample_order, [&](auto sampler) {
        return random_pairs(block, [&](std::uint32_t x, std::uint32_t y) {
            return light_random<float>(sampler.value, job.seed, x, y, sample, count, light);
        });
    });
}

/// Raster positions of camera rays, in pixels.
inline Vec2<Real> raster_positions(const render_cpu::RenderJob& job, const PixelBlock& block,
                                   std::uint32_t camera_ray) noexcept {
    const auto pixel = [](std::uint32_t x) { return static_cast<float>(static_cast<std::int32_t>(x)); };
    if (job.pixel_position == render_cpu::PixelPosition::center)
        return random_pairs(block, [&](std::uint32_t x, std::uint32_t y) {
            return Vec2<float>{pixel(x) + 0.5f, pixel(y) + 0.5f};
        });
    return with_sampler(job.sample_order, [&](auto sampler) {
        return random_pairs(block, [&](std::uint32_t x, std::uint32_t y) {
            const Vec2<float> u = camera_random<float>(sampler.value, job.seed, x, y, camera_ray);
            return Vec2<float>{pixel(x) + u.x, pixel(y) + u.y};
        });
    });
}

} // namespace kernel
NUSSELT_NAMESPACE_END
