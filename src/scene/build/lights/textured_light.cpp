#include "scene/build/lights/textured_light.h"

#include "scene/build/lights/emission_warnings.h"
#include "scene/build/lights/shown_images.h"
#include "scene/colour/colour_space.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

namespace nusselt::scene {

namespace {

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

/// Equal parts of an image have equal corners then, wherever the lights that show them are.
TexturePoint without_rounding(const TexturePoint& p) {
    constexpr double kStep = 1.0 / (std::int64_t{1} << 32);
    return {std::nearbyint(p.x / kStep) * kStep, std::nearbyint(p.y / kStep) * kStep};
}

/// The lights of one shape. Their radiance is the mean of the texels until finish() multiplies it.
class TexturedPolygons {
public:
    TexturedPolygons(const ShapeDescription& shape, ShownImages& images, BuiltShape& built)
        : shape_(shape), image_(shape.emission.texture), images_(images), built_(built) {}

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
        for (const Float3& vertex : vertices) corners.push_back(without_rounding(map(vertex)));
        ShownImage shown = images_.show(image_, corners);
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
    ShownImages& images_;
    BuiltShape& built_;
    std::vector<PolygonLight> lights_;
    std::size_t textured_ = 0;
    std::size_t black_ = 0; ///< polygons that are no lights
};

} // namespace

void add_textured_polygons(const ShapeDescription& shape, const FormatWords& words,
                           PolygonPartition&& partition, ShownImages& images, BuiltShape& built) {
    TexturedPolygons polygons(shape, images, built);
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
