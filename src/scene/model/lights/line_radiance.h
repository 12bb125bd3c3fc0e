#pragma once
/// The radiance of a line or tube that emits an image, in the form of the library.

#include "scene/model/library_vector.h"
#include "scene/model/lights/line_light.h"
#include "scene/model/lights/textured_emission.h"
#include "scene/model/vector_math.h"

#include <nusselt/line_emission/line_profile.h>

#include <vector>

namespace nusselt::scene {

/// Radiance along a light [W/(sr m^2)]. \param emission that of the light
inline LineProfile<float, kMaxLineTexels> radiance_along(const LineLight& light,
                                                         const TexturedEmission& emission) {
    const std::vector<Vec3<float>> texels =
        scaled(emission.texture->texels, per_channel_ratio(light.radiance, emission.mean));
    return make_line_profile<kMaxLineTexels>(texels.data(), static_cast<int>(texels.size()));
}

} // namespace nusselt::scene
