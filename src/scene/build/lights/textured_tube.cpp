#include "scene/build/lights/textured_tube.h"

#include "scene/build/lights/emission_warnings.h"
#include "scene/build/textures/emission_images.h"
#include "scene/colour/colour_space.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace nusselt::scene {

namespace {

/// The means of rows, and whether any row is not uniform.
struct Rows {
    std::vector<Double3> mean;
    bool vary = false;
};

Rows rows_of(const EmissionTexture& image) {
    Rows rows;
    const auto width = static_cast<std::size_t>(image.width);
    for (std::size_t first = 0; first < image.texels.size(); first += width) {
        Double3 sum;
        for (std::size_t i = first; i < first + width; ++i) {
            sum = sum + to_double(image.texels[i]);
            rows.vary = rows.vary || !(image.texels[i] == image.texels[first]);
        }
        rows.mean.push_back((1.0 / image.width) * sum);
    }
    return rows;
}

/// Means over parts of equal length. \param parts no more than there are rows
std::vector<Float3> reduced(const std::vector<Double3>& rows, std::size_t parts) {
    std::vector<Float3> texels;
    const double rows_per_part = static_cast<double>(rows.size()) / static_cast<double>(parts);
    for (std::size_t k = 0; k < parts; ++k) {
        const double begin = static_cast<double>(k) * rows_per_part;
        const double end = begin + rows_per_part;
        Double3 sum;
        for (std::size_t row = static_cast<std::size_t>(begin);
             row < rows.size() && static_cast<double>(row) < end; ++row) {
            const double from = std::max(begin, static_cast<double>(row));
            const double to = std::min(end, static_cast<double>(row + 1));
            sum = sum + (to - from) * rows[row];
        }
        texels.push_back(to_float((1 / rows_per_part) * sum));
    }
    return texels;
}

/// The mean over the lateral surface and the caps.
Float3 mean_over(const std::vector<Float3>& texels, const LineLight& light) {
    Double3 sum;
    for (const Float3& texel : texels) sum = sum + to_double(texel);
    const double lateral = lateral_area(light);
    const double cap = 0.5 * (area(light) - lateral);
    const Double3 on_side = (lateral / static_cast<double>(texels.size())) * sum;
    const Double3 on_caps = cap * (to_double(texels.front()) + to_double(texels.back()));
    return to_float((1 / area(light)) * (on_side + on_caps));
}

} // namespace

TexturedEmission show_rows(const EmissionTexture& image, const LineLight& light) {
    const Rows rows = rows_of(image);
    std::vector<Float3> texels = reduced(rows.mean, std::min<std::size_t>(rows.mean.size(), kMaxLineTexels));
    TexturedEmission shown;
    shown.mean = lit_channels(mean_over(texels, light));
    const bool is_uniform =
        std::all_of(texels.begin(), texels.end(), [&](const Float3& t) { return t == texels.front(); });
    if (is_uniform) return shown;
    const int count = static_cast<int>(texels.size());
    shown.texture = std::make_shared<const EmissionTexture>(
        EmissionTexture{image.name, 1, count, std::move(texels), image.path});
    shown.largest = largest_texel(*shown.texture);
    return shown;
}

void add_textured_tube(const ShapeDescription& shape, const FormatWords& words, LineLight light,
                       BuiltShape& built) {
    const EmissionTexture& image = *shape.emission.texture;
    const Rows rows = rows_of(image);
    if (rows.vary)
        built.warnings.add(shape.origin, "texture around tube",
                           subject_of(shape) + ": each row of the image is replaced by its mean, " +
                               "because radiance varies along tubes only");
    if (image.height > kMaxLineTexels)
        built.warnings.add(shape.origin, "texture of tube",
                           subject_of(shape) + ": the " + std::to_string(image.height) +
                               " rows of the image are reduced to " + std::to_string(kMaxLineTexels));
    const TexturedEmission shown = show_rows(image, light);
    const Float3& mean = shown.mean;
    if (is_black(mean)) {
        make_dark(shape, black_image(image.name), built);
        return;
    }

    Emission outwards = shape.emission;
    outwards.two_sided = false;
    const Float3 radiance =
        radiance_of(outwards, area(light) * luminance(to_double(mean)), words.emission, shape.origin);
    light.radiance = lit_channels(per_channel_product(radiance, mean));
    if (is_black(light.radiance)) {
        make_dark(shape, black_image(image.name), built);
        return;
    }
    check_radiance(light.radiance, words.emission, shape.origin);
    if (shown.texture != nullptr) {
        check_radiance(brightest_radiance(light.radiance, shown.mean, shown.largest), words.emission,
                       shape.origin);
        light.texture = static_cast<std::int32_t>(built.emission_textures.size());
        built.emission_textures.push_back(shown);
    }
    built.lights.of<LineLight>() = {light};
}

} // namespace nusselt::scene
