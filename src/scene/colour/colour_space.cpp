#include "scene/colour/colour_space.h"

#include "scene/model/transform.h"

#include <algorithm>
#include <iterator>

namespace nusselt::scene {

namespace {

constexpr ColourSpace kColourSpaces[] = {
    kSrgb,
    {"dci-p3", {0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kWhiteD65},
    {"rec2020", {0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kWhiteD65},
    {"aces2065-1", {0.7347, 0.2653}, {0, 1}, {0.0001, -0.0770}, {0.32168, 0.33767}},
};

Transform from_basis(const Double3& x, const Double3& y, const Double3& z) {
    return from_columns({x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, 0, 0, 0, 1});
}

/// All matrices here belong to known colour spaces.
Transform inverse_of_regular(const Transform& t) { return inverse(t).value_or(Transform{}); }

Transform xyz_from_rgb(const ColourSpace& space) {
    const Transform primaries = from_basis(xyz_of(space.red), xyz_of(space.green), xyz_of(space.blue));
    return primaries * scaling(transform_vector(inverse_of_regular(primaries), xyz_of(space.white)));
}

/// Takes `white` to D65 (Bradford's cone responses, as in ICC profiles).
Transform adaptation(const Chromaticity& white) {
    const Transform cones =
        from_basis({0.8951, -0.7502, 0.0389}, {0.2664, 1.7135, -0.0685}, {-0.1614, 0.0367, 1.0296});
    const Double3 from = transform_vector(cones, xyz_of(white));
    const Double3 to = transform_vector(cones, xyz_of(kWhiteD65));
    return inverse_of_regular(cones) * scaling({to.x / from.x, to.y / from.y, to.z / from.z}) * cones;
}

const Transform& srgb_matrix() {
    static const Transform kMatrix = inverse_of_regular(xyz_from_rgb(kSrgb));
    return kMatrix;
}

} // namespace

const ColourSpace* find_colour_space(std::string_view name) {
    const auto* const found = std::find_if(std::begin(kColourSpaces), std::end(kColourSpaces),
                                           [&](const ColourSpace& space) { return space.name == name; });
    return found != std::end(kColourSpaces) ? found : nullptr;
}

Double3 xyz_of(const Chromaticity& chromaticity) {
    const auto& [x, y] = chromaticity;
    return {x / y, 1, (1 - x - y) / y};
}

Double3 srgb_from_xyz(const Double3& xyz) { return transform_vector(srgb_matrix(), xyz); }

Double3 to_srgb(const Double3& rgb, const ColourSpace& space, SpectrumUse use) {
    if (space.name == kSrgb.name) return rgb;
    const Double3 xyz = transform_vector(xyz_from_rgb(space), rgb);
    return srgb_from_xyz(use == SpectrumUse::albedo ? transform_vector(adaptation(space.white), xyz) : xyz);
}

double luminance(const Double3& srgb) {
    static const Transform kMatrix = xyz_from_rgb(kSrgb);
    return transform_vector(kMatrix, srgb).y;
}

} // namespace nusselt::scene
