#include "scene/model/profiles/profile_radiance.h"

#include <nusselt/emission/profile_radiance.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nusselt::scene {

const double kGrazingCosine = nusselt::kGrazingCosine<double>;

double flat_radiance(const IntensityProfile& profile, double area, const Double3& direction) {
    if (!(direction.z > 0)) return 0;
    return profile_radiance(profile.intensity(direction), kLumensPerWatt, area, direction.z);
}

double share_lost_by_flat_light(const IntensityProfile& profile) {
    const double flux = profile.flux();
    if (!(flux > 0)) return 0;
    const double grazing = std::acos(kGrazingCosine);
    const double emitted = profile.flux_between(0, grazing) +
                           profile.cosine_flux_between(grazing, std::numbers::pi / 2) / kGrazingCosine;
    return std::clamp(1 - emitted / flux, 0.0, 1.0);
}

double box_radiance(const IntensityProfile& profile, const BoxSize& size, const Double3& direction) {
    const double across_x = size.y * size.z;
    const double across_y = size.x * size.z;
    const double across_z = size.x * size.y;
    const double seen = across_x * std::fabs(direction.x) + across_y * std::fabs(direction.y) +
                        across_z * std::fabs(direction.z);
    const double least = kGrazingCosine * std::max({across_x, across_y, across_z});
    return profile.intensity(direction) / (kLumensPerWatt * std::max(seen, least));
}

} // namespace nusselt::scene
