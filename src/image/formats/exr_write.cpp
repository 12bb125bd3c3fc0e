// EXR files are written without Imf::OutputFile, which takes some 1500 bytes of memory for each channel: more than the
// pixels of a small image with the light of each of very many lamps.

#include "base/atomic_file.h"
#include "image/codecs.h"
#include "image/formats/exr_part.h"
#include "image/layers.h"

#include <OpenEXR/ImfAttribute.h>
#include <OpenEXR/ImfPixelType.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace nusselt::image {

namespace {

static_assert(std::endian::native == std::endian::little, "the format is little endian");

/// 255 bytes is the limit of names in EXR; two names, a dot and a prefix must fit.
constexpr std::size_t kMaxNameLength = 200;

/// Channels with names above this length need a bit in the header.
constexpr std::size_t kMaxShortName = 31;

/// The pixels of each layer. Those in the layers themselves are not used, so that pictures need not be copied there.
using LayerData = std::vector<const std::vector<float>*>;

struct Channel {
    const Layer* layer;
    std::size_t number; ///< in its layer

    const std::string& name() const { return layer->channels[number]; }
};

void check_name(const std::string& name) {
    if (name.empty() || name.size() > kMaxNameLength || name.find('\0') != std::string::npos)
        throw std::invalid_argument("the name '" + name + "' must have 1 to 200 bytes, none zero");
}

void check_window(const Window& window) {
    constexpr int kFarthest = std::numeric_limits<int>::max() / 4;
    if (window.width < 1 || window.height < 1) throw std::invalid_argument("a window of an image is empty");
    if (std::abs(std::int64_t(window.x)) > kFarthest || std::abs(std::int64_t(window.y)) > kFarthest)
        throw std::invalid_argument("a window of an image is too far from the origin");
}

void check_layer(const Layer& layer, std::size_t float_count, std::size_t pixel_count) {
    if (layer.channels.empty() || float_count != layer.channels.size() * pixel_count) {
        throw std::invalid_argument("layer '" + layer.name + "' has " + std::to_string(float_count) +
                                    " floats for " + std::to_string(pixel_count) + " pixels of " +
                                    std::to_string(layer.channels.size()) + " channels");
    }
}

[[noreturn]] void fail_on_name(const Channel& channel) {
    throw std::invalid_argument("channel '" + full_name(*channel.layer, channel.name()) +
                                "' must be unique and must not have a dot after the name of its layer");
}

/// Compares full names, without making them where that can be avoided.
bool name_before(const Channel& a, const Channel& b) {
    const std::string_view x = a.layer->name;
    const std::string_view y = b.layer->name;
    const std::size_t shorter = std::min(x.size(), y.size());
    if (const int order = x.substr(0, shorter).compare(y.substr(0, shorter)); order != 0) return order < 0;
    if (x.size() == y.size()) return a.name() < b.name();
    return full_name(*a.layer, a.name()) < full_name(*b.layer, b.name());
}

/// All channels in the order of files: that of their names.
std::vector<Channel> checked_channels(const LayeredImage& image, const LayerData& data) {
    check_window(image.data);
    check_window(image.display);
    check_size(image.data.width, image.data.height);
    const std::size_t pixel_count = std::size_t(image.data.width) * std::size_t(image.data.height);
    std::size_t count = 0;
    for (const Layer& layer : image.layers) count += layer.channels.size();
    std::vector<Channel> channels;
    channels.reserve(count);
    for (std::size_t number = 0; number < image.layers.size(); ++number) {
        const Layer& layer = image.layers[number];
        check_layer(layer, data[number]->size(), pixel_count);
        for (std::size_t i = 0; i < layer.channels.size(); ++i) {
            const Channel channel = channels.emplace_back(Channel{&layer, i});
            check_name(channel.name());
            check_name(full_name(layer, channel.name()));
            if (channel.name().find('.') != std::string::npos) fail_on_name(channel);
        }
    }
    if (channels.empty()) throw std::invalid_argument("cannot write an image without layers");
    std::sort(channels.begin(), channels.end(), name_before);
    const auto repeated =
        std::adjacent_find(channels.begin(), channels.end(),
                           [](const Channel& a, const Channel& b) { return !name_before(a, b); });
    if (repeated != channels.end()) fail_on_name(*repeated);
    for (const auto& [key, value] : image.metadata) check_name(key);
    for (const auto& [key, value] : image.foreign_metadata) check_name(key);
    return channels;
}

Imath::Box2i exr_window(const Window& window) {
    return {{window.x, window.y}, {window.x + window.width - 1, window.y + window.height - 1}};
}

Imf::Header make_header(const LayeredImage& image) {
    Imf::Header header(exr_window(image.display), exr_window(image.data));
    // Noise in the mantissa hardly compresses. 1024 x 1024 noisy pixels on two cores, median of seven:
    // none 26 ms, 12.6 MB; RLE 48 ms, 12.6 MB; ZIPS 126 ms, 12.6 MB; ZIP 140 ms, 12.0 MB; PIZ 200 ms, 11.1 MB.
    header.compression() = Imf::NO_COMPRESSION;
    insert_metadata(header, image.metadata);
    for (const auto& [key, value] : image.foreign_metadata) header.insert(key, Imf::StringAttribute(value));
    return header;
}

template <class Number>
void put(std::ostream& stream, Number number) {
    stream.write(reinterpret_cast<const char*>(&number), sizeof number);
}

void put_name(std::ostream& stream, const std::string& name) {
    stream.write(name.c_str(), std::streamsize(name.size() + 1));
}

/// The value of the attribute `channels`.
void put_channel_list(std::ostream& stream, const std::vector<Channel>& channels) {
    for (const Channel& channel : channels) {
        put_name(stream, full_name(*channel.layer, channel.name()));
        put<std::int32_t>(stream, Imf::FLOAT);
        put<std::int32_t>(stream, 0); // a hint for lossy compression, and three bytes that are always zero
        put<std::int32_t>(stream, 1); // one value for each pixel along both axes
        put<std::int32_t>(stream, 1);
    }
    put<char>(stream, 0);
}

std::uint64_t channel_list_size(const std::vector<Channel>& channels) {
    std::uint64_t size = 1;
    for (const Channel& channel : channels) size += full_name(*channel.layer, channel.name()).size() + 1 + 16;
    return size;
}

std::string value_of(const Imf::Attribute& attribute) {
    Imf::StdOSStream sink;
    attribute.writeValueTo(sink, Imf::EXR_VERSION);
    return sink.str();
}

void put_header(std::ostream& stream, const Imf::Header& header, const std::vector<Channel>& channels) {
    bool has_long_names = false;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
        has_long_names |= std::string_view(attribute.name()).size() > kMaxShortName;
    for (const Channel& channel : channels)
        has_long_names |= full_name(*channel.layer, channel.name()).size() > kMaxShortName;
    put<std::int32_t>(stream, Imf::MAGIC);
    put<std::int32_t>(stream, Imf::EXR_VERSION | (has_long_names ? Imf::LONG_NAMES_FLAG : 0));
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const std::string name = attribute.name();
        put_name(stream, name);
        put_name(stream, attribute.attribute().typeName());
        if (name == "channels") {
            put(stream, std::int32_t(channel_list_size(channels)));
            put_channel_list(stream, channels);
        } else {
            const std::string value = value_of(attribute.attribute());
            put(stream, std::int32_t(value.size()));
            stream << value;
        }
    }
    put<char>(stream, 0);
}

/// The rows of pixels: each with its channels one after the other.
void put_rows(std::ostream& stream, const LayeredImage& image, const LayerData& data,
              const std::vector<Channel>& channels) {
    const auto width = std::size_t(image.data.width);
    const std::uint64_t row_bytes = channels.size() * width * sizeof(float);
    std::uint64_t position = std::uint64_t(stream.tellp()) + std::uint64_t(image.data.height) * 8;
    for (int y = 0; y < image.data.height; ++y, position += 8 + row_bytes) put(stream, position);
    std::vector<float> values(width);
    for (int y = 0; y < image.data.height; ++y) {
        put<std::int32_t>(stream, image.data.y + y);
        put(stream, std::int32_t(row_bytes));
        for (const Channel& channel : channels) {
            const std::size_t stride = channel.layer->channels.size();
            const auto layer = std::size_t(channel.layer - image.layers.data());
            const float* value = data[layer]->data() + std::size_t(y) * width * stride + channel.number;
            for (float& copy : values) {
                copy = *value;
                value += stride;
            }
            stream.write(reinterpret_cast<const char*>(values.data()),
                         std::streamsize(width * sizeof(float)));
        }
    }
}

void write(const std::filesystem::path& path, const LayeredImage& image, const LayerData& data) {
    const std::vector<Channel> channels = checked_channels(image, data);
    std::size_t name_bytes = 0;
    for (const Channel& channel : channels) name_bytes += full_name(*channel.layer, channel.name()).size();
    if (const auto reason = why_not_one_exr(image.data.width, channels.size(), name_bytes))
        throw std::runtime_error("'" + path.string() + "': " + *reason);
    const Imf::Header header = make_header(image);
    base::write_atomically(path, [&](std::ofstream& stream) {
        put_header(stream, header, channels);
        put_rows(stream, image, data, channels);
    });
}

} // namespace

std::optional<std::string> why_not_one_exr(int width, std::size_t channels, std::size_t name_bytes) {
    constexpr auto kMost = std::uint64_t(std::numeric_limits<std::int32_t>::max());
    if (channels * std::uint64_t(width) * sizeof(float) <= kMost && name_bytes + 17 * channels < kMost)
        return std::nullopt;
    return std::to_string(channels) + " channels of " + std::to_string(width) +
           " pixels along x exceed the 2 GiB that EXR files can hold per row and for the list of channels";
}

void write_layers(const std::filesystem::path& path, const LayeredImage& image) {
    LayerData data;
    data.reserve(image.layers.size());
    for (const Layer& layer : image.layers) data.push_back(&layer.data);
    write(path, image, data);
}

void write_exr(const std::filesystem::path& path, const Image& picture, const Metadata& metadata) {
    const Window window = {0, 0, picture.width, picture.height};
    write(path, {window, window, {color_layer({})}, metadata, {}}, {&picture.pixels});
}

} // namespace nusselt::image
