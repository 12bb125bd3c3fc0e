#pragma once
/// A deliberately wrong renderer, to test the tests.

#include "visibility/ray_packets.h"

#include <cmath>

namespace nusselt::render_test {

/// Traces rays as another tracer does, but loses a share of the shadow rays, chosen by a hash of the ray.
class LossyTracer {
public:
    /// \param inner must outlive this object
    /// \param loss  share of shadow rays that are lost, in [0, 1]
    LossyTracer(const visibility::RayTracer& inner, double loss) : inner_(inner), loss_(loss) {}

    /// Valid as long as this object.
    visibility::RayTracer tracer() const {
        return {
            {intersect<4>, occluded<4>}, {intersect<8>, occluded<8>}, {intersect<16>, occluded<16>}, this};
    }

private:
    template <int N>
    static void intersect(const void* context, std::uint32_t active, const visibility::RayPacket<N>& rays,
                          visibility::HitPacket<N>& hits) {
        const LossyTracer& self = *static_cast<const LossyTracer*>(context);
        static_cast<const visibility::PacketTracer<N>&>(self.inner_)
            .intersect(self.inner_.context, active, rays, hits);
    }

    template <int N>
    static std::uint32_t occluded(const void* context, std::uint32_t active,
                                  const visibility::RayPacket<N>& rays) {
        const LossyTracer& self = *static_cast<const LossyTracer*>(context);
        std::uint32_t blocked = static_cast<const visibility::PacketTracer<N>&>(self.inner_)
                                    .occluded(self.inner_.context, active, rays);
        for (int i = 0; i < N; ++i) {
            const double hash = std::fmod(std::fabs(rays.direction[0][i]) * 1e5, 1.0);
            blocked |= static_cast<std::uint32_t>(hash < self.loss_) << i;
        }
        return blocked & active;
    }

    visibility::RayTracer inner_;
    double loss_;
};

} // namespace nusselt::render_test
