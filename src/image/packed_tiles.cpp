#include "image/packed_tiles.h"

#include "image/codecs.h"
#include "image/content_hash.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace nusselt::image {

namespace {

constexpr int kMaxTileSize = 4096;
constexpr int kMaxPosition = 1 << 30;
constexpr std::string_view kDigits = "0123456789abcdef";

/// 4 GiB of floats, as in files of whole images.
constexpr std::int64_t kMaxValueCount = std::int64_t(1) << 30;

/// Of the whole image, relative to the pixels of the file. A small file that claims to be part of a huge image must
/// not take much memory.
constexpr std::int64_t kMaxExpansion = std::int64_t(1) << 14;

/// Behind the hash under kPackedHashKey, if unpack() has added the layer of samples.
constexpr const char* kAddedSamples = " without samples";

[[noreturn]] void fail_as_damaged() {
    throw std::runtime_error(
        "its list of tiles is damaged, or another program has changed its size; use the file as "
        "`nusselt render` wrote it");
}

int tiles_along(int begin, int count, int size) { return (begin + count - 1) / size - begin / size + 1; }

} // namespace

PackedTiles::PackedTiles(const Window& whole, int size)
    : whole_(whole),
      size_(size),
      columns_(tiles_along(whole.x, whole.width, size)),
      rows_(tiles_along(whole.y, whole.height, size)),
      is_there_(std::size_t(columns_) * std::size_t(rows_)) {}

PackedTiles::PackedTiles(const std::string& text) {
    std::istringstream stream(text);
    std::string digits;
    stream >> whole_.x >> whole_.y >> whole_.width >> whole_.height >> size_ >> digits;
    if (!stream || whole_.x < 0 || whole_.x > kMaxPosition || whole_.y < 0 || whole_.y > kMaxPosition ||
        size_ < 1 || size_ > kMaxTileSize)
        fail_as_damaged();
    if (std::string more; stream >> more) fail_as_damaged();
    check_size(whole_.width, whole_.height);
    // Before there is memory for each tile.
    const std::int64_t tiles = std::int64_t(tiles_along(whole_.x, whole_.width, size_)) *
                               tiles_along(whole_.y, whole_.height, size_);
    if (std::int64_t(digits.size()) != (tiles + 3) / 4) fail_as_damaged();
    *this = PackedTiles(whole_, size_);
    for (std::size_t i = 0; i < 4 * digits.size(); ++i) {
        const std::size_t digit = kDigits.find(digits[i / 4]);
        if (digit == std::string_view::npos) fail_as_damaged();
        const bool is_set = (digit >> (3 - i % 4) & 1) != 0;
        if (i < is_there_.size())
            is_there_[i] = is_set;
        else if (is_set)
            fail_as_damaged();
    }
}

void PackedTiles::add(int x, int y) {
    const auto column = std::size_t(x / size_ - whole_.x / size_);
    const auto row = std::size_t(y / size_ - whole_.y / size_);
    is_there_[row * std::size_t(columns_) + column] = true;
}

std::string PackedTiles::text() const {
    std::ostringstream stream;
    stream << whole_.x << ' ' << whole_.y << ' ' << whole_.width << ' ' << whole_.height << ' ' << size_
           << ' ';
    for (std::size_t i = 0; i < is_there_.size(); i += 4) {
        unsigned digit = 0;
        for (std::size_t k = i; k < i + 4; ++k) digit = 2 * digit + (k < is_there_.size() && is_there_[k]);
        stream << kDigits[digit];
    }
    return stream.str();
}

std::size_t PackedTiles::chosen_count() const {
    return std::size_t(std::count(is_there_.begin(), is_there_.end(), true));
}

Window PackedTiles::window() const {
    // The fewest empty cells among shapes that are not too far from a square, so that the mosaic is easy to look at.
    const std::size_t count = std::max<std::size_t>(chosen_count(), 1); // files are never empty
    const auto most = std::size_t(std::sqrt(double(count)));
    const auto columns_for = [&](std::size_t rows) { return (count + rows - 1) / rows; };
    std::size_t best = most;
    for (std::size_t rows = most; rows >= 1 && rows >= most / 2; --rows)
        if (rows * columns_for(rows) < best * columns_for(best)) best = rows;
    return {0, 0, int(columns_for(best)) * size_, int(best) * size_};
}

std::vector<PixelRun> PackedTiles::runs() const {
    const Window cells = window();
    const int cells_per_row = cells.width / size_;
    std::vector<PixelRun> runs;
    int cell = 0;
    for (std::size_t i = 0; i < is_there_.size(); ++i) {
        if (!is_there_[i]) continue;
        // In pixels of the whole image; tiles at its edges may have fewer rows and columns.
        const int left = (whole_.x / size_ + int(i) % columns_) * size_ - whole_.x;
        const int top = (whole_.y / size_ + int(i) / columns_) * size_ - whole_.y;
        const int x_begin = std::max(left, 0);
        const int count = std::min(left + size_, whole_.width) - x_begin;
        const int y_begin = std::max(top, 0);
        const int y_end = std::min(top + size_, whole_.height);
        for (int y = y_begin; y < y_end; ++y) {
            const std::size_t row =
                std::size_t(cell / cells_per_row) * std::size_t(size_) + std::size_t(y - y_begin);
            runs.push_back(
                {row * std::size_t(cells.width) + std::size_t(cell % cells_per_row) * std::size_t(size_),
                 std::size_t(y) * std::size_t(whole_.width) + std::size_t(x_begin), std::size_t(count)});
        }
        ++cell;
    }
    return runs;
}

std::optional<PackedTiles> packed_tiles_of(const LayeredImage& file) {
    const auto found = file.metadata.find(kTilesKey);
    if (found == file.metadata.end()) return std::nullopt;
    PackedTiles tiles(found->second);
    if (!(tiles.window() == file.data)) fail_as_damaged();
    return tiles;
}

LayeredImage pack(LayeredImage&& image, const PackedTiles& tiles) {
    const std::vector<PixelRun> runs = tiles.runs();
    const auto hash = image.metadata.extract(kPackedHashKey);
    if (hash && hash.mapped().ends_with(kAddedSamples))
        std::erase_if(image.layers, [](const Layer& layer) { return layer.name == kSamplesLayer; });
    image.data = tiles.window();
    const std::size_t pixels = std::size_t(image.data.width) * std::size_t(image.data.height);
    for (Layer& layer : image.layers) {
        const std::size_t channels = layer.channels.size();
        std::vector<float> packed(channels * pixels);
        for (const PixelRun& run : runs)
            std::copy_n(layer.data.data() + channels * run.whole, channels * run.count,
                        packed.data() + channels * run.packed);
        layer.data = std::move(packed);
    }
    image.metadata[kTilesKey] = tiles.text();
    if (hash)
        image.metadata[kContentHashKey] = hash.mapped().substr(0, hash.mapped().find(' '));
    else
        add_content_hash(image);
    return std::move(image);
}

namespace {

/// Adds the number of samples as a layer, in the order of names, if the file has it among its metadata only.
/// \returns whether it has
bool add_samples_layer(LayeredImage& file) {
    const auto text = file.metadata.find(kSamplesLayer);
    if (text == file.metadata.end() || find_layer(file, kSamplesLayer) != nullptr) return false;
    float count = 0;
    std::from_chars(text->second.data(), text->second.data() + text->second.size(), count);
    if (!(count > 0)) return false;
    const bool is_header = !file.layers.empty() && file.layers.front().data.empty();
    const std::size_t pixels = std::size_t(file.data.width) * std::size_t(file.data.height);
    const auto after = std::find_if(file.layers.begin(), file.layers.end(),
                                    [](const Layer& layer) { return layer.name > kSamplesLayer; });
    file.layers.insert(after, {kSamplesLayer, {"Y"}, std::vector<float>(is_header ? 0 : pixels, count)});
    return true;
}

/// Puts the pixels of all layers to their places.
LayeredImage placed(LayeredImage&& file, const PackedTiles& tiles) {
    const std::vector<PixelRun> runs = tiles.runs();
    const std::int64_t packed_pixels = std::int64_t(file.data.width) * file.data.height;
    file.data = tiles.whole();
    file.metadata.erase(kTilesKey);
    file.metadata.erase(kContentHashKey);
    const std::int64_t pixels = std::int64_t(file.data.width) * file.data.height;
    if (pixels / packed_pixels > kMaxExpansion)
        throw std::runtime_error(
            "it holds less than 1/16384 of its image; use `nusselt merge --partial` to see it");
    std::int64_t channel_count = 0;
    for (const Layer& layer : file.layers) channel_count += std::int64_t(layer.channels.size());
    if (channel_count > kMaxValueCount / pixels)
        throw std::runtime_error("the image of which it is a part has " + std::to_string(channel_count) +
                                 " channels, which exceed 2^30 values in total; remove some of them");
    with_memory_for(file.data.width, file.data.height, channel_count, [&] {
        for (Layer& layer : file.layers) {
            if (layer.data.empty()) continue; // only the header was read
            const std::size_t channels = layer.channels.size();
            std::vector<float> whole(channels * std::size_t(pixels));
            for (const PixelRun& run : runs)
                std::copy_n(layer.data.data() + channels * run.packed, channels * run.count,
                            whole.data() + channels * run.whole);
            layer.data = std::move(whole);
        }
    });
    return std::move(file);
}

} // namespace

LayeredImage unpack(LayeredImage&& file) {
    const std::optional<PackedTiles> tiles = packed_tiles_of(file);
    if (!tiles) return std::move(file);
    const bool has_data = std::any_of(file.layers.begin(), file.layers.end(),
                                      [](const Layer& layer) { return !layer.data.empty(); });
    if (has_data) check_content_hash(file);
    const bool has_added = add_samples_layer(file);
    if (const auto hash = file.metadata.extract(kContentHashKey))
        file.metadata[kPackedHashKey] = hash.mapped() + (has_added ? kAddedSamples : "");
    return placed(std::move(file), *tiles);
}

LayeredImage unpack_layer(LayeredImage&& file, std::string_view name) {
    const std::optional<PackedTiles> tiles = packed_tiles_of(file);
    if (!tiles) return std::move(file);
    if (name == kSamplesLayer) add_samples_layer(file);
    return placed(std::move(file), *tiles);
}

} // namespace nusselt::image
