#include "scene/build/lights/textured_light.h"

#include "scene/build/lights/emission_warnings.h"
#include "scene/build/textures/emission_images.h"
#include "scene/colour/colour_space.h"
#include "scene/model/library_vector.h"
#include "scene/model/vector_math.h"

#include <nusselt/emission/textured_light.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

namespace nusselt::scene {

namespace {

/// The most texels of the part of an image that one light shows, if it repeats those at the edge.
constexpr double kMaxWindowTexels = 1 << 26;

/// Texture coordinates as an affine function of positions.
struct TextureMap {
    Double3 origin;
    TexturePoint at_origin;
    Double3 gradient_x, gradient_y; ///< in the plane of the triangle

    TexturePoint operator()(const Float3& position) const {
        const Double3 offset = to_double(position) - origin;
        return {at_origin.x + dot(gradient_x, offset), at_origin.y + dot(gradient_y, offset)};
    }
};

/// The function with the coordinates of a triangle.
TextureMap texture_map(const Mesh& mesh, const Triangle& triangle) {
    const auto& [i, j, k] = triangle.vertex;
    const Double3 origin = to_double(mesh.positions[i]);
    const Double3 a = to_double(mesh.positions[j]) - origin;
    const Double3 b = to_double(mesh.positions[k]) - origin;
    const Double3 normal = cross(a, b);
    const double inverse = 1 / dot(normal, normal);
    const Double3 dual_a = inverse * cross(b, normal);
    const Double3 dual_b = inverse * cross(normal, a);
    const auto gradient = [&](float first, float second, float third) {
        return (static_cast<double>(second) - first) * dual_a + (static_cast<double>(third) - first) * dual_b;
    };
    const Float2& p = mesh.uvs[i];
    const Float2& q = mesh.uvs[j];
    const Float2& r = mesh.uvs[k];
    return {origin, {p.x, p.y}, gradient(p.x, q.x, r.x), gradient(p.y, q.y, r.y)};
}

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

/// The lights of one shape. Their radiance is the mean of the texels until finish() multiplies it.
class TexturedPolygons {
public:
    TexturedPolygons(const ShapeDescription& shape, BuiltShape& built)
        : shape_(shape), image_(shape.emission.texture), built_(built) {}

    /// Adds the polygons on which texture coordinates are an affine function, and the triangles of the others.
    void add(PolygonPartition&& partition) {
        std::vector<std::vector<std::uint32_t>> triangles(partition.polygons.size());
        for (std::uint32_t i = 0; i < built_.triangles.size(); ++i)
            triangles[static_cast<std::size_t>(partition.polygon_of_triangle[i])].push_back(i);
        built_.triangle_light.resize(built_.triangles.size());
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const TextureMap map = texture_map(built_, largest(triangles[i]));
            if (is_map_of(map, triangles[i])) {
                add_light(std::move(partition.polygons[i]), map, triangles[i]);
                continue;
            }
            for (const std::uint32_t number : triangles[i]) {
                const Triangle& triangle = built_.triangles[number];
                PolygonVertices vertices;
                for (const std::uint32_t vertex : triangle.vertex)
                    vertices.push_back(built_.positions[vertex]);
                add_light(std::move(vertices), texture_map(built_, triangle), {number});
            }
        }
    }

    /// Warns if only some polygons show anything but black. The others are surfaces without light.
    void warn_of_black_parts() const {
        if (black_ == 0 || lights_.empty()) return;
        built_.warnings.add(shape_.origin, "black parts of images",
                            subject_of(shape_) + ": " + std::to_string(black_) + " of " +
                                std::to_string(black_ + lights_.size()) +
                                " polygons emit no light because their part of the image is black");
    }

    /// The area of all lights, each times the luminance of its mean texel [m^2].
    double bright_area() const {
        double sum = 0;
        for (const PolygonLight& light : lights_) sum += area(light) * luminance(to_double(light.radiance));
        return sum;
    }

    /// Adds the lights to the shape. \param radiance of a texel of 1
    void finish(const Float3& radiance) {
        for (PolygonLight& light : lights_)
            light.radiance = lit_channels(per_channel_product(radiance, light.radiance));
        built_.lights.of<PolygonLight>() = std::move(lights_);
        if (textured_ > kMaxTexturedPolygons)
            built_.warnings.add(shape_.origin, "many textured lights",
                                subject_of(shape_) + ": of " + std::to_string(textured_) +
                                    " polygons that emit an image, those after the first " +
                                    std::to_string(kMaxTexturedPolygons) +
                                    " emit the mean of their part of it");
    }

private:
    const Triangle& largest(const std::vector<std::uint32_t>& triangles) const {
        const auto size = [&](std::uint32_t number) {
            const auto& [i, j, k] = built_.triangles[number].vertex;
            const Double3 origin = to_double(built_.positions[i]);
            return length(
                cross(to_double(built_.positions[j]) - origin, to_double(built_.positions[k]) - origin));
        };
        std::uint32_t best = triangles.front();
        for (const std::uint32_t number : triangles)
            if (size(number) > size(best)) best = number;
        return built_.triangles[best];
    }

    /// Whether the map agrees with the texture coordinates up to a small part of a texel.
    bool is_map_of(const TextureMap& map, const std::vector<std::uint32_t>& triangles) const {
        constexpr double kTolerance = 1.0 / 64; // texels
        for (const std::uint32_t number : triangles) {
            for (const std::uint32_t vertex : built_.triangles[number].vertex) {
                const TexturePoint mapped = map(built_.positions[vertex]);
                const Float2& uv = built_.uvs[vertex];
                if (!(std::fabs(mapped.x - uv.x) * image_->width <= kTolerance) ||
                    !(std::fabs(mapped.y - uv.y) * image_->height <= kTolerance))
                    return false;
            }
        }
        return true;
    }

    void add_light(PolygonVertices&& vertices, const TextureMap& map,
                   const std::vector<std::uint32_t>& triangles) {
        std::vector<TexturePoint> corners;
        for (const Float3& vertex : vertices) corners.push_back(map(vertex));
        ShownImage shown = show_image(image_, corners);
        const bool is_dark = is_black(shown.emission.mean);
        for (const std::uint32_t triangle : triangles)
            built_.triangle_light[triangle] = is_dark ? -1 : static_cast<std::int32_t>(lights_.size());
        if (is_dark) {
            ++black_;
            return;
        }
        lights_.push_back({.vertices = std::move(vertices),
                           .radiance = shown.emission.mean,
                           .two_sided = shape_.emission.two_sided});
        set_texture(std::move(shown), lights_.back());
    }

    void set_texture(ShownImage&& shown, PolygonLight& light) {
        if (shown.is_far)
            built_.warnings.add(shape_.origin, "far texture coordinates",
                                subject_of(shape_) +
                                    ": texture coordinates are so far outside of the image " +
                                    "that its mean colour is emitted");
        if (shown.emission.texture == nullptr || ++textured_ > kMaxTexturedPolygons) return;
        light.texture = static_cast<std::int32_t>(built_.emission_textures.size());
        built_.emission_textures.push_back(std::move(shown.emission));
    }

    const ShapeDescription& shape_;
    const std::shared_ptr<const EmissionTexture>& image_;
    BuiltShape& built_;
    std::vector<PolygonLight> lights_;
    std::size_t textured_ = 0;
    std::size_t black_ = 0; ///< polygons that are no lights
};

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

void add_textured_polygons(const ShapeDescription& shape, const FormatWords& words,
                           PolygonPartition&& partition, BuiltShape& built) {
    TexturedPolygons polygons(shape, built);
    polygons.add(std::move(partition));
    polygons.warn_of_black_parts();
    if (const double area = polygons.bright_area(); area > 0)
        polygons.finish(radiance_of(shape.emission, area, words.emission, shape.origin));
    const std::vector<PolygonLight>& lights = built.lights.of<PolygonLight>();
    if (std::all_of(lights.begin(), lights.end(),
                    [](const PolygonLight& light) { return is_black(light.radiance); })) {
        make_dark(shape, black_image(shape.emission.texture->name), built);
        return;
    }
    for (const PolygonLight& light : lights) {
        check_radiance(light.radiance, words.emission, shape.origin);
        if (light.texture < 0) continue;
        const TexturedEmission& emission = built.emission_textures[static_cast<std::size_t>(light.texture)];
        check_radiance(brightest_radiance(light.radiance, emission.mean, emission.largest), words.emission,
                       shape.origin);
    }
}

} // namespace nusselt::scene
