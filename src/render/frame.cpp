#include "render/frame.h"

#include "render/film.h"
#include "render/memory.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <utility>

namespace nusselt::render {

namespace {

constexpr int kTileSize = 16;

using Channels = std::vector<std::string>;

const Channels kRgb = {"R", "G", "B"};

/// Name and channels of a layer.
using LayerFormat = std::pair<std::string, Channels>;

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
    constexpr std::size_t kMaxLength = 150;
    std::string name = without_folders(emitter).substr(0, kMaxLength);
    for (char& c : name) {
        const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (!is_letter && !(c >= '0' && c <= '9') && c != '-') c = '_';
    }
    return "light." + (name.empty() ? "unnamed" : name);
}

/// One name for each emitter, no two the same.
std::vector<std::string> light_layer_names(const std::vector<scene::Emitter>& emitters) {
    std::vector<std::string> names;
    std::set<std::string> used;
    for (std::size_t i = 0; i < emitters.size(); ++i) {
        std::string name = layer_name(emitters[i].name);
        if (used.count(name) != 0) name += "." + std::to_string(i);
        used.insert(name);
        names.push_back(name);
    }
    return names;
}

std::vector<LayerFormat> layer_formats(const scene::Scene& scene, const RenderSettings& settings) {
    const auto wanted = [&](LayerKind kind) {
        return std::find(settings.layers.begin(), settings.layers.end(), kind) != settings.layers.end();
    };
    std::vector<LayerFormat> formats;
    if (wanted(LayerKind::albedo)) formats.push_back({"albedo", kRgb});
    if (wanted(LayerKind::normal)) formats.push_back({"normal", {"X", "Y", "Z"}});
    if (wanted(LayerKind::depth)) {
        formats.push_back({"depth", {"Z"}});
        formats.push_back({"coverage", {"Y"}});
    }
    const bool wants_diffuse = wanted(LayerKind::diffuse);
    const bool wants_specular = wanted(LayerKind::specular);
    if (wanted(LayerKind::emission) || wants_diffuse || wants_specular) formats.push_back({"emission", kRgb});
    if (wants_diffuse) formats.push_back({"diffuse", kRgb});
    if (wants_specular) formats.push_back({"specular", kRgb});
    if (wanted(LayerKind::lights))
        for (const std::string& name : light_layer_names(scene.emitters)) formats.push_back({name, kRgb});
    if (wanted(LayerKind::pieces) && settings.light_samples == LightSamples::lines)
        formats.push_back({"pieces", {"Y"}});
    if (wanted(LayerKind::variance) && has_variance(settings)) formats.push_back({"variance", kRgb});
    return formats;
}

/// The number of samples per pixel as a layer.
image::Layer samples_layer(const Frame& frame, double samples) {
    image::Layer layer{"samples", {"Y"}, std::vector<float>(frame.image.pixels.size() / 3)};
    for (std::size_t i = 0; i < frame.tiles.size(); ++i) {
        if (frame.is_finished[i] == 0) continue;
        const Tile& tile = frame.tiles[i];
        for (int y = tile.y_begin; y < tile.y_end; ++y) {
            const auto row = layer.data.begin() +
                             static_cast<std::ptrdiff_t>(y - frame.bounds.y_begin) * frame.image.width;
            std::fill(row + (tile.x_begin - frame.bounds.x_begin), row + (tile.x_end - frame.bounds.x_begin),
                      static_cast<float>(samples));
        }
    }
    return layer;
}

} // namespace

Frame make_frame(const scene::Scene& scene, const RenderSettings& settings) {
    Frame frame;
    frame.bounds = rendered_pixels(scene.film);
    const int width = frame.bounds.x_end - frame.bounds.x_begin;
    const int height = frame.bounds.y_end - frame.bounds.y_begin;
    image::check_size(width, height);
    const std::vector<LayerFormat> formats = layer_formats(scene, settings);
    std::size_t channel_count = 3;
    for (const auto& [name, channels] : formats) channel_count += channels.size();
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    check_memory(sizeof(float) * channel_count * pixels,
                 "an image of " + std::to_string(width) + " x " + std::to_string(height) + " pixels with " +
                     std::to_string(channel_count) + " channels",
                 "use a lower --resolution or fewer --layers");

    frame.image = image::make_image(width, height);
    for (const auto& [name, channels] : formats)
        frame.layers.push_back({name, channels, std::vector<float>(channels.size() * pixels)});
    frame.tiles = make_tiles(frame.bounds);
    if (settings.part.count > 1) frame.tiles = tiles_of_part(frame.tiles, settings.part);
    frame.is_finished.resize(frame.tiles.size());
    return frame;
}

std::uint64_t pixel_count(const Tile& tile) {
    return static_cast<std::uint64_t>(tile.x_end - tile.x_begin) *
           static_cast<std::uint64_t>(tile.y_end - tile.y_begin);
}

double finished_fraction(const Frame& frame) {
    std::uint64_t all = 0;
    std::uint64_t finished = 0;
    for (std::size_t i = 0; i < frame.tiles.size(); ++i) {
        all += pixel_count(frame.tiles[i]);
        if (frame.is_finished[i] != 0) finished += pixel_count(frame.tiles[i]);
    }
    return all == 0 ? 1 : frame.finished_share * static_cast<double>(finished) / static_cast<double>(all);
}

image::LayeredImage to_layered_image(Frame&& frame, const scene::Film& film, const RenderSettings& settings,
                                     image::Metadata metadata) {
    image::LayeredImage result;
    result.data = {frame.bounds.x_begin, frame.bounds.y_begin, frame.image.width, frame.image.height};
    result.display = {0, 0, film.width, film.height};
    result.metadata = std::move(metadata);
    const bool is_whole = settings.part.count == 1 && finished_fraction(frame) == 1;
    image::Layer samples;
    if (!is_whole) samples = samples_layer(frame, std::round(frame.finished_share * settings.samples));
    result.layers.push_back({"", kRgb, std::move(frame.image.pixels)});
    for (image::Layer& layer : frame.layers) result.layers.push_back(std::move(layer));
    if (!is_whole) result.layers.push_back(std::move(samples));
    return result;
}

} // namespace nusselt::render
