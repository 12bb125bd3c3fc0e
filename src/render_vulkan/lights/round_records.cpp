// Spheres, disks, ellipses and ellipsoids, for shaders/passes/rounds/round.glsl.

#include "render_vulkan/lights/light_records.h"
#include "render_vulkan/record_values.h"
#include "scene/model/lights/round/round_form.h"
#include "visibility/round_surfaces.h"

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

std::vector<interface::RoundLightRecord> make_round_records(const scene::Scene& scene) {
    std::vector<interface::RoundLightRecord> lights;
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
        record.triangle = interface::kNoTriangle;
    }
    for (const visibility::RoundSurface& surface : visibility::make_round_surfaces(scene)) {
        interface::RoundLightRecord& record = lights.at(surface.round_light);
        float* const rows[] = {record.inverse0, record.inverse1, record.inverse2};
        for (std::size_t i = 0; i < surface.inverse.size(); ++i)
            rows[i / 3][i % 3] = static_cast<float>(surface.inverse[i]);
        record.triangle = surface.triangle;
        record.is_partial = surface.is_partial ? 1 : 0;
        record.rounding = static_cast<float>(surface.rounding);
        record.shrinkage = static_cast<float>(surface.shrinkage);
    }
    return lights;
}

void write_rounds(const scene::Scene& scene, const scene::LightList& list, LightRecords& records) {
    const auto& rounds = dynamic_cast<const scene::LightsOf<scene::RoundLight>&>(list);
    for (const scene::RoundLight& light : rounds.lights) records.has_shape_of(constant_of(light)) = true;
    records.array_at(interface::kRoundLightsBinding) =
        make_light_array("spheres and disks", make_round_records(scene));
}

} // namespace nusselt::render_vulkan
