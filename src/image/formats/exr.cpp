#include "image/codecs.h"
#include "image/formats/exr_part.h"
#include "image/packed_tiles.h"

#include <OpenEXR/ImfChannelList.h>

#include <stdexcept>
#include <utility>

namespace nusselt::image {

namespace {

const std::vector<std::string> kRgb = {"R", "G", "B"};

/// Luminance alone; with RY and BY beside it, Y is one third of a colour image.
bool is_grey(const ExrPart& part) {
    const Imf::ChannelList& channels = part.header().channels();
    return part.has_full_resolution("Y") && channels.findChannel("RY") == nullptr &&
           channels.findChannel("BY") == nullptr;
}

bool is_rgb(const ExrPart& part) {
    return part.has_full_resolution("R") && part.has_full_resolution("G") && part.has_full_resolution("B");
}

/// Parts of an image hold tiles only; see packed_tiles.h.
Image whole_image(const ExrPart& part, Image image) {
    Metadata metadata = text_attributes(part.header()).ours;
    if (metadata.count(kTilesKey) == 0) return image;
    const Window window = {part.header().dataWindow().min.x, part.header().dataWindow().min.y, image.width,
                           image.height};
    LayeredImage whole =
        unpack_layer({window, window, {color_layer(std::move(image))}, std::move(metadata), {}}, "");
    return layer_image(whole.data, std::move(whole.layers[0]));
}

} // namespace

Image decode_exr(std::ifstream& stream) {
    ExrPart part(stream);
    const bool rgb = is_rgb(part);
    if (!rgb && !is_grey(part)) {
        throw std::runtime_error(
            "the channels R, G and B, or Y alone, must exist at full resolution; the file has " +
            channel_names(part.header()));
    }
    Image image{part.width(), part.height(), {}};
    if (rgb) {
        part.read({{kRgb, &image.pixels}});
        return whole_image(part, std::move(image));
    }
    std::vector<float> grey;
    part.read({{{"Y"}, &grey}});
    image.pixels.reserve(3 * grey.size());
    for (const float value : grey) image.pixels.insert(image.pixels.end(), 3, value);
    return whole_image(part, std::move(image));
}

Metadata decode_exr_metadata(std::ifstream& stream) { return text_attributes(ExrPart(stream).header()).ours; }

} // namespace nusselt::image
