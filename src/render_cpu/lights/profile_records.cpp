#include "render_cpu/lights/profile_records.h"

#include "scene/model/profiles/emission_profile.h"
#include "scene/model/vector_math.h"

#include <optional>

namespace nusselt::render_cpu {

ProfileRecord ProfileRecords::make(const scene::ProfiledEmission& emission,
                                   const scene::ProfilePlacement& placement) {
    const scene::EmissionProfile& profile = *emission.profile;
    ProfileRecord record{};
    record.x_axis = to_float(placement.x_axis);
    record.y_axis = to_float(placement.y_axis);
    record.z_axis = to_float(placement.z_axis);
    record.normal = to_float(placement.normal);
    if (const std::optional<double> slope = scene::spread_slope(profile))
        record.inverse_slope = static_cast<float>(1 / *slope);
    record.inverse_mean = emission.mean > 0 ? 1 / emission.mean : 0.0f;
    if (profile.luminaire == nullptr) return record;
    // With areas relative to the least one and intensities over this, all numbers are of the order of the luminance.
    const double unit = least_visible_area(profile);
    record.luminaire = luminaires_.add(profile.luminaire, unit);
    std::vector<LuminousFaceRecord>& faces = faces_.emplace_back();
    for (const scene::LuminousFace& face : profile.faces)
        faces.push_back({to_float(face.normal), static_cast<float>(face.area / unit)});
    record.faces = faces.data();
    record.face_count = static_cast<std::int32_t>(faces.size());
    record.round_axis = to_float(profile.round.axis);
    record.round_area = static_cast<float>(profile.round.area / unit);
    record.least_area = 1;
    return record;
}

} // namespace nusselt::render_cpu
