#pragma once
/// Makes the polygonal lights of a shape that emits an image.

#include "scene/build/build_shape.h"
#include "scene/build/polygons/polygon_merge.h"

#include <memory>
#include <span>

namespace nusselt::scene {

/// The most lights with a texture that one shape may have. The polygons of others have the mean of their part of the image.
inline constexpr std::size_t kMaxTexturedPolygons = 1024;

/// Adds the lights of a shape whose emission has a texture. Texture coordinates must be an affine function on each light: a
/// polygon on which they are not is split into its triangles. Where texture coordinates have no area, the light is uniform.
void add_textured_polygons(const ShapeDescription& shape, const FormatWords& words,
                           PolygonPartition&& partition, BuiltShape& built);

/// Texture coordinates of a vertex.
struct TexturePoint {
    double x = 0, y = 0;
};

/// What a polygon shows of an image.
struct ShownImage {
    TexturedEmission emission; ///< without a texture if the polygon has the mean everywhere
    bool is_far =
        false; ///< whether that is so because it shows too many repetitions of the edge of the image
};

/// Crops an image to a polygon. Where texture coordinates hardly change, the polygon shows the mean.
/// \param corners an affine function of the vertices, at most 8
ShownImage show_image(const std::shared_ptr<const EmissionTexture>& image,
                      std::span<const TexturePoint> corners);

} // namespace nusselt::scene
