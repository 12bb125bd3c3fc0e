#include "image/codecs.h"
#include "image/formats/exr_part.h"
#include "image/layers.h"
#include "image/packed_tiles.h"

#include <OpenEXR/ImfChannelList.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

namespace nusselt::image {

namespace {

/// 4 GiB of floats.
constexpr std::int64_t kMaxValueCount = std::int64_t(1) << 30;

/// R, G, B and A come first, in this order.
bool channel_before(const std::string& a, const std::string& b) {
    static constexpr std::string_view kFirst = "RGBA";
    const auto rank = [](const std::string& name) {
        return name.size() == 1 ? std::min(kFirst.find(name), kFirst.size()) : kFirst.size();
    };
    return std::pair(rank(a), a) < std::pair(rank(b), b);
}

/// The layers of a file, without data.
std::vector<Layer> empty_layers(const ExrPart& part) {
    std::map<std::string, std::vector<std::string>> channels_of_layer;
    const Imf::ChannelList& channels = part.header().channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string name = channel.name();
        if (!part.has_full_resolution(name)) continue;
        const std::size_t dot = name.rfind('.');
        if (dot == std::string::npos) {
            channels_of_layer[""].push_back(name);
        } else {
            channels_of_layer[name.substr(0, dot)].push_back(name.substr(dot + 1));
        }
    }
    std::vector<Layer> layers;
    for (auto& [name, names] : channels_of_layer) {
        std::sort(names.begin(), names.end(), channel_before);
        layers.push_back({name, std::move(names), {}});
    }
    return layers;
}

/// Clamps the size, which the file may choose freely for the display window.
Window window_of(const Imath::Box2i& box) {
    const auto size = [](int low, int high) {
        const std::int64_t value = std::int64_t(high) - low + 1;
        return int(std::clamp<std::int64_t>(value, 0, std::numeric_limits<int>::max()));
    };
    return {box.min.x, box.min.y, size(box.min.x, box.max.x), size(box.min.y, box.max.y)};
}

/// All but the data.
LayeredImage layer_list(const ExrPart& part) {
    ExrMetadata metadata = text_attributes(part.header());
    return {window_of(part.header().dataWindow()), window_of(part.header().displayWindow()),
            empty_layers(part), std::move(metadata.ours), std::move(metadata.foreign)};
}

/// Fills all layers of the list.
void read_data(ExrPart& part, LayeredImage& image) {
    std::vector<ChannelGroup> groups;
    std::int64_t channel_count = 0;
    for (Layer& layer : image.layers) {
        ChannelGroup group = {{}, &layer.data};
        for (const std::string& channel : layer.channels) group.channels.push_back(full_name(layer, channel));
        channel_count += std::int64_t(layer.channels.size());
        groups.push_back(std::move(group));
    }
    if (channel_count > kMaxValueCount / (std::int64_t(part.width()) * part.height()))
        throw std::runtime_error("the image has " + std::to_string(channel_count) +
                                 " channels, which exceed 2^30 values in total; remove some of them");
    part.read(groups);
}

} // namespace

LayeredImage decode_exr_layer_list(std::ifstream& stream) { return unpack(layer_list(ExrPart(stream))); }

LayeredImage decode_exr_packed_layers(std::ifstream& stream) {
    ExrPart part(stream);
    LayeredImage image = layer_list(part);
    read_data(part, image);
    return image;
}

LayeredImage decode_exr_layers(std::ifstream& stream) { return unpack(decode_exr_packed_layers(stream)); }

LayeredImage decode_exr_layer(std::ifstream& stream, std::string_view layer) {
    ExrPart part(stream);
    LayeredImage image = layer_list(part);
    std::erase_if(image.layers, [&](const Layer& other) { return other.name != layer; });
    if (!image.layers.empty()) read_data(part, image);
    return unpack_layer(std::move(image), layer);
}

const Layer* find_layer(const LayeredImage& image, std::string_view name) {
    const auto found = std::find_if(image.layers.begin(), image.layers.end(),
                                    [&](const Layer& layer) { return layer.name == name; });
    return found == image.layers.end() ? nullptr : &*found;
}

Image layer_image(const Window& data, Layer layer) {
    const std::size_t count = layer.channels.size();
    const bool has_alpha = count == 4 && layer.channels[3] == "A";
    if (count != 1 && count != 3 && !has_alpha) {
        throw std::runtime_error("layer '" + layer.name + "' has " + std::to_string(count) +
                                 " channels; a picture must have 1, 3, or R, G, B and A");
    }
    if (count > 1) {
        // In place: a copy could be too large.
        if (has_alpha)
            for (std::size_t i = 0; i < layer.data.size() / 4 * 3; ++i)
                layer.data[i] = layer.data[i / 3 * 4 + i % 3];
        layer.data.resize(layer.data.size() / count * 3);
        return {data.width, data.height, std::move(layer.data)};
    }
    Image result =
        with_memory_for(data.width, data.height, 3, [&] { return make_image(data.width, data.height); });
    for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] = layer.data[i / 3];
    return result;
}

Layer color_layer(Image image) { return {"", {"R", "G", "B"}, std::move(image.pixels)}; }

} // namespace nusselt::image
