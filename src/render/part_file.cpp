#include "render/part_file.h"

#include "scene/model/content_hash.h"

#include <cinttypes>
#include <cstdint>
#include <cstdio>

namespace nusselt::render {

std::string content_hash(const image::LayeredImage& image) {
    std::uint64_t sum = 0;
    for (const image::Layer& layer : image.layers) {
        scene::ContentHash hash;
        hash.add_bytes(layer.name.data(), layer.name.size());
        hash.add_bytes(layer.data.data(), layer.data.size() * sizeof(float));
        sum += hash.value();
    }
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, sum);
    return text;
}

} // namespace nusselt::render
