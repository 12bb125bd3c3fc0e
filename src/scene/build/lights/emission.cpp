#include "scene/build/lights/emission.h"

#include "scene/build/textures/emission_images.h"
#include "scene/colour/colour_space.h"
#include "scene/model/limits.h"
#include "scene/model/vector_math.h"

#include <numbers>

namespace nusselt::scene {

void check_emission(const Float3& value, const EmissionQuantity& quantity, std::string_view subject,
                    const Location& location) {
    for (const float channel : {value.x, value.y, value.z})
        if (!(channel >= 0 && channel <= kMaxRadiance))
            throw SceneError(location, std::string(subject) + ": " + std::string(quantity.name) +
                                           " must be from 0 to " + to_text(kMaxRadiance) + ", found " +
                                           to_text(channel));
}

void check_radiance(const Float3& radiance, std::string_view subject, const Location& location) {
    check_emission(radiance, kRadiance, subject, location);
}

Float3 brightest_radiance(const Float3& radiance, const Float3& mean, const Float3& largest) {
    return per_channel_product(per_channel_ratio(radiance, mean), largest);
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

Emission without_texture(const Emission& emission) {
    Emission result = emission;
    result.texture = nullptr;
    if (emission.texture == nullptr) return result;
    const Float3 mean = lit_channels(mean_texel(*emission.texture));
    result.radiance = per_channel_product(emission.radiance, mean);
    if (const double brightness = luminance(to_double(mean)); emission.power && brightness > 0)
        result.power = *emission.power / brightness;
    return result;
}

} // namespace nusselt::scene
