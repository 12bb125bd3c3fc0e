#include "scene/build/emission.h"

#include "scene/model/limits.h"
#include "scene/model/vector_math.h"

#include <numbers>

namespace nusselt::scene {

void check_radiance(const Float3& radiance, std::string_view subject, const Location& location) {
    for (const float value : {radiance.x, radiance.y, radiance.z})
        if (!(value >= 0 && value <= kMaxRadiance))
            throw SceneError(location, std::string(subject) + ": radiance must be from 0 to " +
                                           to_text(kMaxRadiance) + ", found " + to_text(value));
}

Float3 radiance_of(const Emission& emission, double area, std::string_view subject,
                   const Location& location) {
    if (!emission.power) return emission.radiance;
    const double sides = emission.two_sided ? 2 : 1;
    const Float3 radiance =
        to_float((*emission.power / (sides * std::numbers::pi * area)) * to_double(emission.radiance));
    check_radiance(radiance, subject, location);
    return radiance;
}

} // namespace nusselt::scene
