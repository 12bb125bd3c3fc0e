#pragma once
/// Makes equal-area maps of the octahedron from images of environments.

#include "scene/model/scene.h"

#include <optional>

namespace nusselt::scene {

/// How an image shows all directions.
enum class EnvironmentImage {
    octahedral, ///< square, equal-area; the upper left corner of the image is that of the map
    latitude,   ///< azimuth from x to y along its width, inclination from +z at the upper border
};

/// Square images of a suitable size keep their texels. Others become interpolated maps with at least as many.
EnvironmentMapTexels make_environment_map_texels(const Texture& image, EnvironmentImage kind);

/// The kind of an image by its proportions: pbrt v4 has square ones, and other programs write images in latitudes. Nothing if it is
/// neither square nor twice as wide as high.
std::optional<EnvironmentImage> image_kind(const Texture& image);

/// A sky by formulas, in the space of the light with the zenith at +z.
struct SkyDescription {
    double turbidity = 3;               ///< see PreethamSky
    Double3 to_sun = {0, 0, 1};         ///< not zero
    Float3 ground = {0.2f, 0.2f, 0.2f}; ///< diffuse albedo of the ground below the horizon

    bool operator==(const SkyDescription&) const = default;
};

/// The sky with the disk of the sun, and below the horizon a ground that both light.
EnvironmentMapTexels make_sky_map(const SkyDescription& sky);

/// The irradiance that a surface with the normal z receives of a map [W/m^2], for each channel.
Double3 irradiance_of(const EnvironmentMapTexels& map);

} // namespace nusselt::scene
