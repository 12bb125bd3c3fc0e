#pragma once
/// An image in the making, with its layers.

#include "image/image.h"
#include "image/layers.h"
#include "render/settings.h"
#include "render/tile.h"
#include "scene/model/scene.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace nusselt::render {

/// What a backend needs to go on with tiles that it began, by the number of each. Only the same backend understands it.
using BegunTiles = std::map<std::size_t, std::vector<std::byte>>;

/// All that a rendering stores of its pixels. What is not rendered is zero.
struct Frame {
    scene::PixelBounds bounds; ///< pixels of the film that the image holds
    image::Image image;
    std::vector<image::Layer> layers;
    int camera_rays = 1;                   ///< of a finished pixel
    std::vector<float> rays;               ///< how many of them each pixel of the image has
    std::vector<Tile> tiles;               ///< the tiles of the part to render
    std::vector<std::uint8_t> is_finished; ///< 1 for tiles whose pixels are final; one for each tile
    /// Tiles that are not finished. Without a map, what a backend needs to go on with them is not kept: nobody will.
    std::optional<BegunTiles> begun;
};

/// How much a frame holds.
struct FrameSize {
    int width = 0; ///< [pixels]
    int height = 0;
    std::size_t layers = 0;   ///< beside the image
    std::size_t channels = 0; ///< with those of the image
    std::size_t tiles = 0;    ///< of 16 x 16 pixels at most, in all parts
    std::size_t bytes = 0;    ///< of memory, also for names and while an EXR file is written
};

/// Whether the settings ask for this layer.
bool is_wanted(const RenderSettings& settings, LayerKind kind);

FrameSize frame_size(const scene::Scene& scene, const RenderSettings& settings);

/// Takes the memory for an image and the layers of the settings.
///
/// Layers are, in this order and if they are asked for: albedo, normal, depth and coverage, emission (with diffuse or
/// specular, too), diffuse, specular, `light.NAME` for each emitter, pieces with line samples, and variance unless there is
/// but one camera ray per pixel. docs/rendering.md says what they hold.
/// \throws std::runtime_error if no file could hold that many pixels or layers, or if the machine does not have the memory
Frame make_frame(const scene::Scene& scene, const RenderSettings& settings);

std::uint64_t pixel_count(const Tile& tile);

/// Marks a tile whose pixels are final.
void finish_tile(Frame& frame, std::size_t tile);

/// Calls a function with the address and the number of the floats of each row of a tile.
/// \param values for each pixel of the frame, const or not
template <class Values, class Function>
void for_each_row(const Frame& frame, const Tile& tile, Values& values, std::size_t channels,
                  const Function& function) {
    const auto width = static_cast<std::size_t>(frame.image.width);
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
        const std::size_t first = static_cast<std::size_t>(y - frame.bounds.y_begin) * width +
                                  static_cast<std::size_t>(tile.x_begin - frame.bounds.x_begin);
        function(values.data() + channels * first,
                 channels * static_cast<std::size_t>(tile.x_end - tile.x_begin));
    }
}

/// The same for the image and then each layer. \param frame const or not
template <class AnyFrame, class Function>
void for_each_row(AnyFrame& frame, const Tile& tile, const Function& function) {
    for_each_row(frame, tile, frame.image.pixels, 3, function);
    for (auto& layer : frame.layers) for_each_row(frame, tile, layer.data, layer.channels.size(), function);
}

/// Share of the camera rays of the part that are there; 1 if there are no pixels to render.
double finished_fraction(const Frame& frame);

/// The frame as it goes into files: with all layers, and one more with the number of samples per pixel unless that is the
/// same in all pixels; of a part, only its tiles (image/packed_tiles.h); with a hash (image/content_hash.h).
/// \param frame is moved from
image::LayeredImage to_layered_image(Frame&& frame, const scene::Film& film, const RenderSettings& settings,
                                     image::Metadata metadata);

} // namespace nusselt::render
