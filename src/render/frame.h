#pragma once
/// An image in the making, with its layers.

#include "image/image.h"
#include "image/layers.h"
#include "render/settings.h"
#include "render/tile.h"
#include "scene/model/scene.h"

#include <cstdint>
#include <vector>

namespace nusselt::render {

/// All that a rendering stores of its pixels. What is not rendered is zero.
struct Frame {
    scene::PixelBounds bounds; ///< pixels of the film that the image holds
    image::Image image;
    std::vector<image::Layer> layers;
    std::vector<Tile> tiles;               ///< the tiles of the part to render
    std::vector<std::uint8_t> is_finished; ///< 1 for tiles whose pixels are final; one for each tile
    /// Share of the samples that finished pixels have: below 1 if a backend was stopped that takes all pixels at once.
    double finished_share = 1;
};

/// Takes the memory for an image and the layers of the settings.
///
/// Layers are, in this order and if they are asked for: albedo, normal, depth and coverage, emission (with diffuse or
/// specular, too), diffuse, specular, `light.NAME` for each emitter, pieces with line samples, and variance unless there is
/// but one camera ray per pixel. docs/rendering.md says what they hold.
/// \throws std::runtime_error if no file could hold that many pixels, or if the machine does not have the memory
Frame make_frame(const scene::Scene& scene, const RenderSettings& settings);

std::uint64_t pixel_count(const Tile& tile);

/// Share of the samples of the part that are there; 1 if there are no pixels to render.
double finished_fraction(const Frame& frame);

/// The frame as it goes into files: with all layers, and one more with the number of samples per pixel unless that is the
/// same in all pixels.
/// \param frame is moved from
image::LayeredImage to_layered_image(Frame&& frame, const scene::Film& film, const RenderSettings& settings,
                                     image::Metadata metadata);

} // namespace nusselt::render
