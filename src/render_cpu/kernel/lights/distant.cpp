// Distant lights.

#include "render_cpu/kernel/lights/one_direction.h"
#include "render_cpu/lights/distant_records.h"

NUSSELT_NAMESPACE_BEGIN
namespace kernel {
namespace {

struct DistantLight {
    using Shape = OneDirection;

    static LocalLight<Shape> local(const ReflectedLight& reflected, const render_cpu::LightSet& lights,
                                   std::int32_t index) noexcept {
        const auto& record = static_cast<const render_cpu::DistantRecord*>(lights.records)[index];
        const Vector to_light = broadcast<Real>(to_vec(record.to_light));
        // Longer than the scene, from any of its points.
        const Real distance(4 * reflected.job().scene.radius);
        return light_in_direction(reflected, to_light, distance * to_light, LaneMask(true),
                                  broadcast<Real>(to_vec(record.irradiance)), lights.first + index);
    }

    static LobeIntegrals integrals(const Shape& shape, const Ltc<Real>& lobe) noexcept {
        return lobes_in_direction(shape, lobe);
    }
};

} // namespace
} // namespace kernel
NUSSELT_NAMESPACE_END

namespace nusselt::render_cpu {

LightCode distant_code(LaneCount<kernel::kLanes>) {
    return kernel::one_direction_code<kernel::DistantLight>();
}

} // namespace nusselt::render_cpu
