#pragma once
/// Images of many layers (colour, albedo, normals, depth, the light of one lamp alone, ...) and their EXR files.

#include "image/channel_names.h"
#include "image/image.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nusselt::image {

/// A group of channels that belong together.
struct Layer {
    /// Empty for the picture itself. Dots are allowed: "light.window" is the light of one lamp.
    std::string name;
    /// The last part of the names of channels, without dots: {"R", "G", "B"}, {"X", "Y", "Z"} or {"Z"}.
    ChannelNames channels;
    /// Row 0 on top, the channels of a pixel side by side. Infinities and NaN are legal.
    std::vector<float> data;
};

/// A rectangle of pixels; (0, 0) is the upper left corner of the film.
struct Window {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    bool operator==(const Window&) const = default;
};

struct LayeredImage {
    Window data;    ///< the pixels that are there
    Window display; ///< the whole film; differs from `data` if only a crop of it was rendered
    std::vector<Layer> layers;
    Metadata metadata;         ///< attributes `nusselt:<key>` of the file, without that prefix
    Metadata foreign_metadata; ///< text attributes of other programs under their full names
};

/// The reason for which no EXR file can hold that many channels; nothing if one can.
/// \param name_bytes  of the names of all channels together
[[nodiscard]] std::optional<std::string> why_not_one_exr(int width, std::size_t channels,
                                                         std::size_t name_bytes);

/// Writes all layers as 32-bit floats into one EXR file without compression. The channel of a layer is called
/// `layer.channel`, as other programs expect it, and just `channel` in the layer without name. The file
/// appears under its name only when it is complete, see base::write_atomically().
/// \throws std::invalid_argument  if a window is empty, a layer has another number of floats than its channels
///                                and the data window need, names repeat, are too long (200 bytes) or, in
///                                channels, empty or with a dot, or a metadata key is too short or too long
/// \throws std::runtime_error     if the file cannot be written, see also why_not_one_exr()
void write_layers(const std::filesystem::path& path, const LayeredImage& image);

/// Reads all channels of full resolution of the first part of an EXR file, whatever wrote it; half floats and
/// integers become floats. Layers come in the order of their names, the one without name first; channels as
/// R, G, B, A, others in the order of their names after them.
/// \throws std::runtime_error  naming the path and what to do if this is no EXR file, if it is damaged or
///                             deep, has more than 2^28 pixels or 2^30 values
[[nodiscard]] LayeredImage read_layers(const std::filesystem::path& path);

/// The same with a single layer, the one of this name, and without layers if there is none.
[[nodiscard]] LayeredImage read_layer(const std::filesystem::path& path, std::string_view name);

/// The same without the data of layers, of which only the header is read.
[[nodiscard]] LayeredImage read_layer_list(const std::filesystem::path& path);

/// \returns nullptr if there is none of that name
[[nodiscard]] const Layer* find_layer(const LayeredImage& image, std::string_view name);

/// A layer as a picture: one channel as grey, three as red, green and blue, of R, G, B, A without the last.
/// \param data  the window of the layer
/// \throws std::runtime_error  naming the layer for other numbers of channels
[[nodiscard]] Image layer_image(const Window& data, Layer layer);

/// The layer without name in R, G and B for an image, ready for write_layers().
[[nodiscard]] Layer color_layer(Image image);

} // namespace nusselt::image
