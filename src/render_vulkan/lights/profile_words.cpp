#include "render_vulkan/lights/profile_words.h"

#include "interface/profiles.h"
#include "render_vulkan/lights/emission_words.h"
#include "scene/model/profiles/emission_profile.h"
#include "scene/model/profiles/line_profile.h"
#include "scene/model/vector_math.h"

#include <bit>
#include <iterator>
#include <optional>
#include <tuple>

namespace nusselt::render_vulkan {

std::uint32_t ProfileWords::add(const scene::Scene& scene, const scene::PolygonLight& light) {
    const auto& emission = scene.emission_profiles.at(static_cast<std::size_t>(light.profile));
    return add(*emission.profile, emission.mean, place_profile(light, emission), interface::kNoWords);
}

std::uint32_t ProfileWords::add(const scene::Scene& scene, const scene::LineLight& light) {
    static_assert(std::tuple_size_v<scene::TubeSpread> == interface::kTubeSpreadCells + 1);
    const auto& emission = scene.emission_profiles.at(static_cast<std::size_t>(light.profile));
    std::uint32_t tube_spread = interface::kNoWords;
    if (const std::optional<double> slope = scene::spread_slope(*emission.profile))
        tube_spread = add_floats(scene::tube_spread(*slope), words_);
    return add(*emission.profile, emission.mean, place_profile(light, emission), tube_spread);
}

std::uint32_t ProfileWords::add(const scene::EmissionProfile& profile, float mean,
                                const scene::ProfilePlacement& placement, std::uint32_t tube_spread) {
    const std::optional<double> slope = scene::spread_slope(profile);
    // With areas relative to the least one and intensities over this, all numbers are of the order of the luminance.
    const double unit = profile.luminaire != nullptr ? scene::least_visible_area(profile) : 1;
    const std::uint32_t luminaire =
        profile.luminaire != nullptr ? luminaires_.add(profile.luminaire, unit, words_) : interface::kNoWords;

    const std::uint32_t first = grow_words(words_, interface::kProfileFaces);
    const auto set = [&](std::uint32_t at, float number) {
        words_[first + at] = std::bit_cast<std::uint32_t>(number);
    };
    const auto set_vector = [&](std::uint32_t at, const scene::Double3& vector) {
        const scene::Float3 rounded = to_float(vector);
        for (const float component : {rounded.x, rounded.y, rounded.z}) set(at++, component);
    };
    std::uint32_t at = interface::kProfileAxes;
    for (const scene::Double3& axis : {placement.x_axis, placement.y_axis, placement.z_axis, placement.normal,
                                       scene::honeycomb_axis(placement)}) {
        set_vector(at, axis);
        at += 3;
    }
    set(interface::kProfileInverseSlope, slope ? static_cast<float>(1 / *slope) : 0.0f);
    const auto holes = scene::honeycomb_slopes(profile);
    for (std::uint32_t k = 0; k < 2; ++k)
        set(interface::kProfileInverseHoles + k, holes ? static_cast<float>(1 / (*holes)[k]) : 0.0f);
    set(interface::kProfileInverseMean, mean > 0 ? 1 / mean : 0.0f);
    words_[first + interface::kProfileLuminaire] = luminaire;
    words_[first + interface::kProfileTubeSpread] = tube_spread;
    set_vector(interface::kProfileRoundAxis, profile.round.axis);
    set(interface::kProfileRoundArea, static_cast<float>(profile.round.area / unit));
    words_[first + interface::kProfileFaceCount] = static_cast<std::uint32_t>(profile.faces.size());
    for (const scene::LuminousFace& face : profile.faces) {
        const scene::Float3 normal = to_float(face.normal);
        const float numbers[] = {normal.x, normal.y, normal.z, static_cast<float>(face.area / unit)};
        static_assert(std::size(numbers) == interface::kProfileFaceWords);
        add_floats(numbers, words_);
    }
    return first;
}

} // namespace nusselt::render_vulkan
