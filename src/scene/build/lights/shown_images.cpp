#include "scene/build/lights/shown_images.h"

#include "scene/build/textures/emission_images.h"
#include "scene/model/library_vector.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/textured_light.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nusselt::scene {

namespace {

/// The most texels of the part of an image that one light shows, if it repeats those at the edge.
constexpr double kMaxWindowTexels = 1 << 26;

/// Texels begin to end - 1 of a row or column. Beyond those of the image, the texel at the edge goes on.
struct TexelRange {
    double begin, end;

    double size() const { return end - begin; }
    float relative(double coordinate, int image_size) const {
        return std::clamp(static_cast<float>((coordinate * image_size - begin) / size()), 0.0f, 1.0f);
    }
    bool operator==(const TexelRange&) const = default;
};

/// The texels that interpolation reads between two coordinates.
TexelRange texel_range(double low, double high, int size) {
    constexpr double kRounding = 1.0 / 64; // texels
    const double from = low * size;
    const double to = high * size;
    const double begin =
        from < -kRounding ? std::floor(from) : std::clamp(std::floor(from - 0.5), 0.0, size - 1.0);
    const double end = to > size + kRounding ? std::ceil(to) : std::min(std::floor(to - 0.5) + 2, size + 0.0);
    return {begin, std::max(end, begin + 1)};
}

EmissionTexture crop(const EmissionTexture& image, const TexelRange& columns, const TexelRange& rows) {
    EmissionTexture result{
        image.name, static_cast<int>(columns.size()), static_cast<int>(rows.size()), {}, image.path};
    result.texels.reserve(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height));
    for (double j = rows.begin; j < rows.end; ++j) {
        const std::size_t row = static_cast<std::size_t>(std::clamp(j, 0.0, image.height - 1.0));
        for (double i = columns.begin; i < columns.end; ++i) {
            const std::size_t column = static_cast<std::size_t>(std::clamp(i, 0.0, image.width - 1.0));
            result.texels.push_back(image.texels[row * static_cast<std::size_t>(image.width) + column]);
        }
    }
    return result;
}

/// The mean over a light. \param outline in texture coordinates
Float3 mean_over(const EmissionTexture& texture, std::span<const Vec2<float>> outline) {
    const std::vector<Vec3<float>> texels = scaled(texture.texels, {1, 1, 1});
    const TextureView<float> view{texels.data(), texture.width, texture.height};
    constexpr int kCells = 8;
    const PyramidShape shape(kCells, texture.width, texture.height);
    std::vector<float> storage(static_cast<std::size_t>(shape.size));
    const auto light = make_textured_light<BilinearFilter, kCells>(
        view, outline.data(), static_cast<int>(outline.size()), storage.data());
    return to_float3(light.mean_radiance());
}

double area_of(std::span<const Vec2<float>> outline) {
    double doubled = 0;
    for (std::size_t k = 2; k < outline.size(); ++k)
        doubled += det(outline[k - 1] - outline[0], outline[k] - outline[0]);
    return 0.5 * std::fabs(doubled);
}

/// For lights on which the coordinates hardly change.
Float3 mean_of_corners(const EmissionTexture& texture, std::span<const Vec2<float>> outline) {
    const std::vector<Vec3<float>> texels = scaled(texture.texels, {1, 1, 1});
    const TextureView<float> view{texels.data(), texture.width, texture.height};
    Vec3<float> sum{0, 0, 0};
    for (const Vec2<float>& at : outline) sum += BilinearFilter::lookup(view, at);
    return to_float3(sum / static_cast<float>(outline.size()));
}

std::shared_ptr<const EmissionTexture> part_of_image(const std::shared_ptr<const EmissionTexture>& image,
                                                     const TexelRange& columns, const TexelRange& rows) {
    const TexelRange all_columns{0, static_cast<double>(image->width)};
    const TexelRange all_rows{0, static_cast<double>(image->height)};
    if (columns == all_columns && rows == all_rows) return image;
    return std::make_shared<const EmissionTexture>(crop(*image, columns, rows));
}

/// The least area in texels on which the coordinates are a map that has an inverse in single precision.
constexpr double kLeastArea = 1e-3;

} // namespace

ShownImage show_image(const std::shared_ptr<const EmissionTexture>& image,
                      std::span<const TexturePoint> corners) {
    const auto range = [&](double TexturePoint::*axis, int size) {
        const auto [low, high] = std::minmax_element(
            corners.begin(), corners.end(), [&](const auto& a, const auto& b) { return a.*axis < b.*axis; });
        return texel_range((*low).*axis, (*high).*axis, size);
    };
    const TexelRange columns = range(&TexturePoint::x, image->width);
    const TexelRange rows = range(&TexturePoint::y, image->height);
    ShownImage shown;
    shown.is_far = std::max(columns.size(), rows.size()) > kMaxEmissionTextureSize ||
                   columns.size() * rows.size() > kMaxWindowTexels;
    if (shown.is_far) {
        shown.emission.mean = lit_channels(mean_texel(*image));
        return shown;
    }
    std::vector<Vec2<float>> outline;
    for (const TexturePoint& p : corners)
        outline.push_back({columns.relative(p.x, image->width), rows.relative(p.y, image->height)});
    std::shared_ptr<const EmissionTexture> texture = part_of_image(image, columns, rows);
    if (!(area_of(outline) * columns.size() * rows.size() > kLeastArea)) {
        shown.emission.mean = lit_channels(mean_of_corners(*texture, outline));
        return shown;
    }
    shown.emission.mean = lit_channels(mean_over(*texture, outline));
    shown.emission.largest = largest_texel(*texture);
    shown.emission.texture = std::move(texture);
    for (std::size_t k = 0; k < outline.size(); ++k)
        shown.emission.coordinates[k] = {outline[k].x, outline[k].y};
    const auto share = [](double texels, int size) { return static_cast<float>(texels / size); };
    shown.emission.part_begin = {share(columns.begin, image->width), share(rows.begin, image->height)};
    shown.emission.part_end = {share(columns.end, image->width), share(rows.end, image->height)};
    return shown;
}

ShownImage ShownImages::show(const std::shared_ptr<const EmissionTexture>& image,
                             std::span<const TexturePoint> corners) {
    {
        const std::scoped_lock lock(mutex_);
        if (const Entry* const kept = find(image, corners)) return kept->shown;
    }
    // Other threads need not wait. Two that miss the same part prepare it twice, and share what the first one keeps.
    ShownImage shown = show_image(image, corners);
    const std::scoped_lock lock(mutex_);
    if (const Entry* const kept = find(image, corners)) return kept->shown;
    last_[next_] = {image, {corners.begin(), corners.end()}, shown};
    next_ = (next_ + 1) % last_.size();
    return shown;
}

const ShownImages::Entry* ShownImages::find(const std::shared_ptr<const EmissionTexture>& image,
                                            std::span<const TexturePoint> corners) const {
    const auto is_same = [&](const Entry& entry) {
        return entry.image == image &&
               std::equal(entry.corners.begin(), entry.corners.end(), corners.begin(), corners.end());
    };
    const auto found = std::find_if(last_.begin(), last_.end(), is_same);
    return found != last_.end() ? &*found : nullptr;
}

} // namespace nusselt::scene
