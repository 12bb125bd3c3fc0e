#include "image/content_hash.h"

#include "base/content_hash.h"
#include "image/packed_tiles.h"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace nusselt::image {

namespace {

constexpr std::array<const char*, 4> kHashedKeys = {kTilesKey, "part", "samples", "seed"};

void add_text(const std::string& text, base::ContentHash& hash) { hash.add_bytes(text.data(), text.size()); }

void add_window(const Window& window, base::ContentHash& hash) {
    const std::array<std::int32_t, 4> numbers = {window.x, window.y, window.width, window.height};
    hash.add_bytes(numbers.data(), sizeof numbers);
}

} // namespace

std::string content_hash(const LayeredImage& image) {
    std::vector<const Layer*> layers;
    for (const Layer& layer : image.layers) layers.push_back(&layer);
    std::sort(layers.begin(), layers.end(), [](const Layer* a, const Layer* b) { return a->name < b->name; });
    base::ContentHash hash;
    add_window(image.data, hash);
    add_window(image.display, hash);
    for (const Layer* layer : layers) {
        add_text(layer->name, hash);
        for (const std::string& channel : layer->channels) add_text(channel, hash);
        hash.add_bytes(layer->data.data(), layer->data.size() * sizeof(float));
    }
    for (const char* key : kHashedKeys) {
        const auto found = image.metadata.find(key);
        if (found == image.metadata.end()) continue;
        add_text(key, hash);
        add_text(found->second, hash);
    }
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016" PRIx64, hash.value());
    return text.data();
}

void add_content_hash(LayeredImage& image) { image.metadata[kContentHashKey] = content_hash(image); }

void check_content_hash(const LayeredImage& image) {
    const auto found = image.metadata.find(kContentHashKey);
    if (found == image.metadata.end())
        throw std::runtime_error(
            "its hash is missing: the file is damaged, or another program or an older version has "
            "written it; render it again");
    if (found->second != content_hash(image))
        throw std::runtime_error("its pixels are not those that were written: the file is damaged or "
                                 "incomplete, or another program has changed it; render it again");
}

} // namespace nusselt::image
