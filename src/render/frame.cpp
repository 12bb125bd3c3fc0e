#include "render/frame.h"

#include "image/content_hash.h"
#include "image/packed_tiles.h"
#include "render/film.h"
#include "render/memory.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace nusselt::render {

namespace {

constexpr int kTileSize = 16;

/// Of an emitter, in the name of its layer.
constexpr std::size_t kMaxNameLength = 150;

const image::ChannelNames kRgb = {"R", "G", "B"};

/// Name and channels of a layer.
using LayerFormat = std::pair<std::string, image::ChannelNames>;

/// The number of tiles along an axis that have some of these pixels.
std::size_t tile_count(int begin, int end) {
    return static_cast<std::size_t>((end - 1) / kTileSize - begin / kTileSize + 1);
}

/// The tiles of the film that have some of these pixels, cut to them.
std::vector<Tile> make_tiles(const scene::PixelBounds& bounds) {
    const auto next = [](int position) { return position + kTileSize - position % kTileSize; };
    std::vector<Tile> tiles;
    for (int y = bounds.y_begin; y < bounds.y_end; y = next(y))
        for (int x = bounds.x_begin; x < bounds.x_end; x = next(x))
            tiles.push_back({x, y, std::min(next(x), bounds.x_end), std::min(next(y), bounds.y_end)});
    return tiles;
}

/// Deals tiles out to parts along diagonals, so that each part gets its share of every region of the image.
std::vector<Tile> tiles_of_part(const std::vector<Tile>& tiles, const Part& part) {
    const auto diagonal = [&](std::size_t i) {
        return tiles[i].x_begin / kTileSize + tiles[i].y_begin / kTileSize;
    };
    std::vector<std::size_t> order(tiles.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return diagonal(a) < diagonal(b); });
    const auto count = static_cast<std::size_t>(part.count);
    std::vector<Tile> result;
    for (auto k = static_cast<std::size_t>(part.number - 1); k < order.size(); k += count)
        result.push_back(tiles[order[k]]);
    return result;
}

/// Names of emitters may have the path of a file, which is another one on each machine: of words with slashes, only what
/// is behind the last one counts.
std::string without_folders(const std::string& text) {
    std::string result;
    std::istringstream stream(text);
    for (std::string word; stream >> word;)
        result += (result.empty() ? "" : " ") + word.substr(word.rfind('/') + 1);
    return result;
}

/// Names of channels take letters, digits, hyphens and underscores everywhere.
std::string layer_name(const std::string& emitter) {
    std::string name = without_folders(emitter).substr(0, kMaxNameLength);
    for (char& c : name) {
        const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (!is_letter && !(c >= '0' && c <= '9') && c != '-') c = '_';
    }
    return "light." + (name.empty() ? "unnamed" : name);
}

/// One name for each emitter, no two the same.
std::vector<std::string> light_layer_names(const std::vector<scene::Emitter>& emitters) {
    std::vector<std::string> names;
    names.reserve(emitters.size());
    for (const scene::Emitter& emitter : emitters) names.push_back(layer_name(emitter.name));
    // A set would allocate a node for each name. Once freed, these fragments are too small for layers.
    std::vector<std::size_t> order(names.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair<std::string_view, std::size_t>(names[a], a) <
               std::pair<std::string_view, std::size_t>(names[b], b);
    });
    // The first of each name keeps it. Backwards, so that names are compared as they were.
    for (std::size_t k = order.size(); k-- > 1;)
        if (names[order[k]] == names[order[k - 1]]) names[order[k]] += "." + std::to_string(order[k]);
    return names;
}

/// The layers in front of those of lights.
std::vector<LayerFormat> formats_before_lights(const RenderSettings& settings) {
    std::vector<LayerFormat> formats;
    if (is_wanted(settings, LayerKind::albedo)) formats.push_back({"albedo", kRgb});
    if (is_wanted(settings, LayerKind::normal)) formats.push_back({"normal", {"X", "Y", "Z"}});
    if (is_wanted(settings, LayerKind::depth)) {
        formats.push_back({"depth", {"Z"}});
        formats.push_back({"coverage", {"Y"}});
    }
    const bool wants_diffuse = is_wanted(settings, LayerKind::diffuse);
    const bool wants_specular = is_wanted(settings, LayerKind::specular);
    if (is_wanted(settings, LayerKind::emission) || wants_diffuse || wants_specular)
        formats.push_back({"emission", kRgb});
    if (wants_diffuse) formats.push_back({"diffuse", kRgb});
    if (wants_specular) formats.push_back({"specular", kRgb});
    return formats;
}

std::vector<LayerFormat> formats_behind_lights(const RenderSettings& settings) {
    std::vector<LayerFormat> formats;
    if (is_wanted(settings, LayerKind::pieces) && settings.light_samples == LightSamples::lines)
        formats.push_back({"pieces", {"Y"}});
    if (is_wanted(settings, LayerKind::variance) && has_variance(settings))
        formats.push_back({"variance", kRgb});
    return formats;
}

void add_layers(std::vector<LayerFormat>&& formats, std::size_t pixels, Frame& frame) {
    for (auto& [name, channels] : formats) {
        std::vector<float> data(channels.size() * pixels);
        frame.layers.push_back({std::move(name), std::move(channels), std::move(data)});
    }
}

/// \throws std::runtime_error if no EXR file can hold the layers
void check_file(const FrameSize& size, const std::vector<std::string>& light_names) {
    // The other names are few and short.
    std::size_t name_bytes = 0;
    for (const std::string& name : light_names) name_bytes += kRgb.size() * (name.size() + 2);
    if (const auto reason = image::why_not_one_exr(size.width, size.channels, name_bytes))
        throw std::runtime_error(*reason + "; use a lower --resolution or fewer --layers");
}

/// The number of samples per pixel as a layer.
image::Layer samples_layer(const Frame& frame, const RenderSettings& settings) {
    image::Layer layer{image::kSamplesLayer, {"Y"}, frame.rays};
    const auto samples_per_ray = static_cast<float>(settings.samples / frame.camera_rays);
    for (float& value : layer.data) value *= samples_per_ray;
    return layer;
}

} // namespace

bool is_wanted(const RenderSettings& settings, LayerKind kind) {
    return std::find(settings.layers.begin(), settings.layers.end(), kind) != settings.layers.end();
}

FrameSize frame_size(const scene::Scene& scene, const RenderSettings& settings) {
    // The layer itself, the heap, and lists of all layers and channels.
    constexpr std::size_t kBytesPerLayer = 180;
    const scene::PixelBounds bounds = rendered_pixels(scene.film);
    FrameSize size;
    size.width = bounds.x_end - bounds.x_begin;
    size.height = bounds.y_end - bounds.y_begin;
    std::size_t name_bytes = 0;
    if (is_wanted(settings, LayerKind::lights)) {
        size.layers = scene.emitters.size();
        for (const scene::Emitter& emitter : scene.emitters)
            name_bytes += std::min(emitter.name.size(), kMaxNameLength);
    }
    size.channels = kRgb.size() * (1 + size.layers);
    for (const auto& formats : {formats_before_lights(settings), formats_behind_lights(settings)}) {
        size.layers += formats.size();
        for (const auto& [name, channels] : formats) size.channels += channels.size();
    }
    size.tiles = tile_count(bounds.x_begin, bounds.x_end) * tile_count(bounds.y_begin, bounds.y_end);
    const std::size_t pixels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    size.bytes = sizeof(float) * (size.channels + 1) * pixels + kBytesPerLayer * size.layers + name_bytes;
    return size;
}

Frame make_frame(const scene::Scene& scene, const RenderSettings& settings) {
    const FrameSize size = frame_size(scene, settings);
    image::check_size(size.width, size.height);
    check_memory(size.bytes,
                 "an image of " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                     " pixels with " + std::to_string(size.channels) + " channels",
                 "use a lower --resolution or fewer --layers");
    std::vector<std::string> light_names;
    if (is_wanted(settings, LayerKind::lights)) light_names = light_layer_names(scene.emitters);
    check_file(size, light_names);

    Frame frame;
    frame.bounds = rendered_pixels(scene.film);
    frame.image = image::make_image(size.width, size.height);
    const std::size_t pixels = frame.image.pixels.size() / 3;
    frame.camera_rays = camera_ray_count(settings);
    frame.rays.resize(pixels);
    frame.layers.reserve(size.layers + 2); // to_layered_image() adds two
    add_layers(formats_before_lights(settings), pixels, frame);
    for (std::string& name : light_names)
        frame.layers.push_back({std::move(name), kRgb, std::vector<float>(kRgb.size() * pixels)});
    add_layers(formats_behind_lights(settings), pixels, frame);
    frame.tiles = make_tiles(frame.bounds);
    if (settings.part.count > 1) frame.tiles = tiles_of_part(frame.tiles, settings.part);
    frame.is_finished.resize(frame.tiles.size());
    return frame;
}

std::uint64_t pixel_count(const Tile& tile) {
    return static_cast<std::uint64_t>(tile.x_end - tile.x_begin) *
           static_cast<std::uint64_t>(tile.y_end - tile.y_begin);
}

void finish_tile(Frame& frame, std::size_t tile) {
    frame.is_finished[tile] = 1;
    for_each_row(frame, frame.tiles[tile], frame.rays, 1, [&](float* row, std::size_t size) {
        std::fill_n(row, size, static_cast<float>(frame.camera_rays));
    });
}

double finished_fraction(const Frame& frame) {
    std::uint64_t pixels = 0;
    double rays = 0;
    for (const Tile& tile : frame.tiles) {
        pixels += pixel_count(tile);
        for_each_row(frame, tile, frame.rays, 1, [&](const float* row, std::size_t size) {
            rays = std::accumulate(row, row + size, rays);
        });
    }
    return pixels == 0 ? 1 : rays / (static_cast<double>(frame.camera_rays) * static_cast<double>(pixels));
}

image::LayeredImage to_layered_image(Frame&& frame, const scene::Film& film, const RenderSettings& settings,
                                     image::Metadata metadata) {
    image::LayeredImage result;
    result.data = {frame.bounds.x_begin, frame.bounds.y_begin, frame.image.width, frame.image.height};
    result.display = {0, 0, film.width, film.height};
    result.metadata = std::move(metadata);
    const bool is_finished = finished_fraction(frame) == 1;
    image::Layer samples;
    if (!is_finished) samples = samples_layer(frame, settings);
    result.layers = std::move(frame.layers);
    result.layers.insert(result.layers.begin(), {"", kRgb, std::move(frame.image.pixels)});
    if (!is_finished) result.layers.push_back(std::move(samples));
    if (settings.part.count == 1) {
        add_content_hash(result);
        return result;
    }
    image::PackedTiles tiles(result.data, kTileSize);
    for (const Tile& tile : frame.tiles) tiles.add(tile.x_begin, tile.y_begin);
    return pack(std::move(result), tiles);
}

} // namespace nusselt::render
