// Spheres, disks, ellipses and ellipsoids, for shaders/passes/rounds/round.glsl.

#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/record_values.h"
#include "scene/model/lights/round/round_form.h"
#include "scene/model/lights/round/round_shell.h"

namespace nusselt::render_vulkan {

namespace {

using scene::RoundShape;

constexpr bool is_number_of(RoundShape shape, std::uint32_t number) {
    return static_cast<std::uint32_t>(shape) == number;
}
static_assert(is_number_of(RoundShape::sphere, interface::kSphere) &&
              is_number_of(RoundShape::disk, interface::kDisk) &&
              is_number_of(RoundShape::ellipse, interface::kEllipse) &&
              is_number_of(RoundShape::ellipsoid, interface::kEllipsoid));

} // namespace

int constant_of(const scene::RoundLight& light) {
    return light.model == scene::RoundModel::ellipse ? interface::kEllipsesConstant
                                                     : interface::kEllipsoidsConstant;
}

void write_rounds(const scene::Scene& scene, const scene::LightList& list, LightRecords& records) {
    const auto& rounds = dynamic_cast<const scene::LightsOf<scene::RoundLight>&>(list);
    for (const scene::RoundLight& light : rounds.lights) records.has_shape_of(constant_of(light)) = true;
    std::vector<interface::RoundLightRecord> lights;
    // Here, rays meet flat pieces. The margin is for rounding, and because shadow rays have to end before them.
    constexpr double kMargin = 1e-4;
    const std::vector<double> shells = scene::round_shells(scene);
    auto shell = shells.begin();
    for (const scene::RoundForm& form : round_forms(scene)) {
        interface::RoundLightRecord& record = lights.emplace_back();
        record.shape = static_cast<std::uint32_t>(form.shape);
        copy(form.center, record.center);
        copy(form.axis[0], record.axis0);
        copy(form.axis[1], record.axis1);
        copy(form.axis[2], record.axis2);
        copy(form.inverse[0], record.inverse0);
        copy(form.inverse[1], record.inverse1);
        copy(form.inverse[2], record.inverse2);
        copy(form.normal, record.normal);
        record.radius = form.radius;
        copy(form.radiance, record.radiance);
        record.emits_outwards = static_cast<std::uint32_t>(form.emits_outwards);
        record.emits_inwards = static_cast<std::uint32_t>(form.emits_inwards);
        record.shell = static_cast<float>((1 - kMargin) * *shell++);
    }
    records.array_at(interface::kRoundLightsBinding) = make_light_array("spheres and disks", lights);
}

} // namespace nusselt::render_vulkan
