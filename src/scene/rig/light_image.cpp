#include "scene/rig/light_image.h"

#include "scene/build/lights/emission.h"
#include "scene/build/lights/shown_images.h"
#include "scene/build/lights/textured_tube.h"
#include "scene/colour/colour_space.h"
#include "scene/model/limits.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace nusselt::scene {

namespace {

using Defect = std::optional<FieldDefect>;

/// The radiance of a texel of 1.
Double3 texel_radiance(const GivenImage& given, double brightness_before, double brightness_of_image) {
    if (given.scale) return to_double(*given.scale);
    const double factor = brightness_of_image > 0 ? brightness_before / brightness_of_image : 0;
    return {factor, factor, factor};
}

/// Texture coordinates of a polygon in the whole image.
std::vector<TexturePoint> corners_of(const TexturedEmission& emission, std::size_t count) {
    std::vector<TexturePoint> corners;
    for (std::size_t k = 0; k < count; ++k) {
        const auto at = [](float begin, float end, float share) {
            return double{begin} + double{share} * (double{end} - double{begin});
        };
        const Float2& share = emission.coordinates[k];
        corners.push_back({at(emission.part_begin.x, emission.part_end.x, share.x),
                           at(emission.part_begin.y, emission.part_end.y, share.y)});
    }
    return corners;
}

bool is_parallelogram(const PolygonVertices& vertices) {
    if (vertices.size() != 4) return false;
    constexpr double kTolerance = 1e-4;
    const Double3 side = to_double(vertices[1]) - to_double(vertices[0]);
    const Double3 opposite = to_double(vertices[2]) - to_double(vertices[3]);
    return length(side - opposite) <= kTolerance * length(side);
}

Defect change_polygons(const GivenImage& given, Scene& scene, std::vector<PolygonLight>& lights) {
    std::vector<ShownImage> shown;
    double before = 0, of_image = 0;
    for (const PolygonLight& light : lights) {
        std::vector<TexturePoint> corners;
        if (light.texture >= 0)
            corners = corners_of(scene.emission_textures[static_cast<std::size_t>(light.texture)],
                                 light.vertices.size());
        else if (lights.size() == 1 && is_parallelogram(light.vertices))
            corners = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        else
            return FieldDefect{"image", "a light without an image must be one parallelogram, or a tube"};
        shown.push_back(show_image(given.image, corners));
        before += area(light) * luminance(to_double(light.radiance));
        of_image += area(light) * luminance(to_double(shown.back().emission.mean));
    }
    const Double3 scale = texel_radiance(given, before, of_image);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].radiance = to_float(per_channel_product(scale, to_double(shown[i].emission.mean)));
        lights[i].texture = -1;
        if (shown[i].emission.texture == nullptr) continue;
        lights[i].texture = static_cast<std::int32_t>(scene.emission_textures.size());
        scene.emission_textures.push_back(std::move(shown[i].emission));
    }
    return std::nullopt;
}

Defect change_line(const GivenImage& given, Scene& scene, LineLight& light) {
    TexturedEmission shown = show_rows(*given.image, light);
    const Double3 scale =
        texel_radiance(given, luminance(to_double(light.radiance)), luminance(to_double(shown.mean)));
    light.radiance = to_float(per_channel_product(scale, to_double(shown.mean)));
    light.texture = -1;
    if (shown.texture == nullptr) return std::nullopt;
    light.texture = static_cast<std::int32_t>(scene.emission_textures.size());
    scene.emission_textures.push_back(std::move(shown));
    return std::nullopt;
}

Defect change_map(const GivenImage& given, Scene& scene, EnvironmentLight& light) {
    const Double3 scale =
        texel_radiance(given, luminance(to_double(light.radiance)), luminance(to_double(given.map->mean)));
    light.radiance = to_float(per_channel_product(scale, to_double(given.map->mean)));
    light.map = static_cast<std::int32_t>(scene.environment_maps.size());
    scene.environment_maps.push_back(given.map);
    return std::nullopt;
}

bool has_profile(const EditableLight& light) {
    const auto has_one = [](const auto& part) { return part.profile >= 0; };
    const auto& polygons = light.parts.of<PolygonLight>();
    const auto& lines = light.parts.of<LineLight>();
    return std::any_of(polygons.begin(), polygons.end(), has_one) ||
           std::any_of(lines.begin(), lines.end(), has_one);
}

} // namespace

std::string image_path(const Scene& scene, const EditableLight& light) {
    const auto path = [&](std::int32_t texture) {
        return scene.emission_textures[static_cast<std::size_t>(texture)].texture->path;
    };
    for (const PolygonLight& polygon : light.parts.of<PolygonLight>())
        if (polygon.texture >= 0) return path(polygon.texture);
    for (const LineLight& line : light.parts.of<LineLight>())
        if (line.texture >= 0) return path(line.texture);
    return "";
}

std::string map_path(const Scene& scene, const EditableLight& light) {
    for (const EnvironmentLight& environment : light.parts.of<EnvironmentLight>())
        if (environment.map >= 0)
            return scene.environment_maps[static_cast<std::size_t>(environment.map)]->path;
    return "";
}

std::optional<FieldDefect> change_image(const GivenImage& given, Scene& scene, EditableLight& light) {
    if (given.map != nullptr) {
        std::vector<EnvironmentLight>& environments = light.parts.of<EnvironmentLight>();
        if (environments.size() != light.parts.size())
            return FieldDefect{"map", "only environments have a map; use \"image\" for lights with an area"};
        if (!given.scale && map_path(scene, light) == given.map->path) return std::nullopt;
        if (is_black(given.map->mean)) return FieldDefect{"map", "the map is black"};
        for (EnvironmentLight& environment : environments)
            if (Defect defect = change_map(given, scene, environment)) return defect;
    }
    if (given.image == nullptr) return std::nullopt;
    std::vector<PolygonLight>& polygons = light.parts.of<PolygonLight>();
    std::vector<LineLight>& lines = light.parts.of<LineLight>();
    if (polygons.size() + lines.size() != light.parts.size())
        return FieldDefect{"image",
                           "only polygons, tubes and lines emit an image; environments have a \"map\""};
    if (has_profile(light))
        return FieldDefect{"image", "a light with a profile, a spread or a honeycomb emits no image"};
    if (!given.scale && image_path(scene, light) == given.image->path) return std::nullopt;
    if (!polygons.empty())
        if (Defect defect = change_polygons(given, scene, polygons)) return defect;
    for (LineLight& line : lines)
        if (Defect defect = change_line(given, scene, line)) return defect;
    if (is_black(light)) return FieldDefect{"image", "the light shows nothing but black of the image"};
    return std::nullopt;
}

bool drop_dark_channels(EditableLight& light) {
    const bool was_black = is_black(light);
    const auto drop = [](auto& parts, auto image) {
        for (auto& part : parts)
            if (part.*image >= 0) part.radiance = lit_channels(part.radiance);
    };
    drop(light.parts.of<PolygonLight>(), &PolygonLight::texture);
    drop(light.parts.of<LineLight>(), &LineLight::texture);
    drop(light.parts.of<EnvironmentLight>(), &EnvironmentLight::map);
    return is_black(light) && !was_black;
}

bool has_too_bright_texels(const Scene& scene, const EditableLight& light) {
    const auto is_too_bright = [](const auto& part, const Float3& mean, const Float3& largest) {
        const Float3 most = brightest_radiance(part.radiance, mean, largest);
        return !(std::max({most.x, most.y, most.z}) <= kMaxRadiance);
    };
    const auto shows_too_bright = [&](const auto& part) {
        if (part.texture < 0) return false;
        const TexturedEmission& emission = scene.emission_textures[static_cast<std::size_t>(part.texture)];
        return is_too_bright(part, emission.mean, emission.largest);
    };
    const auto has_too_bright_map = [&](const EnvironmentLight& part) {
        if (part.map < 0) return false;
        const EnvironmentMapTexels& map = *scene.environment_maps[static_cast<std::size_t>(part.map)];
        return is_too_bright(part, map.mean, map.largest);
    };
    const auto& polygons = light.parts.of<PolygonLight>();
    const auto& lines = light.parts.of<LineLight>();
    const auto& environments = light.parts.of<EnvironmentLight>();
    return std::any_of(polygons.begin(), polygons.end(), shows_too_bright) ||
           std::any_of(lines.begin(), lines.end(), shows_too_bright) ||
           std::any_of(environments.begin(), environments.end(), has_too_bright_map);
}

std::optional<FieldDefect> turn_map(const Rotation& rotation, EditableLight& light) {
    std::vector<EnvironmentLight>& environments = light.parts.of<EnvironmentLight>();
    if (environments.empty()) return FieldDefect{"rotate_map", "only environments have a map"};
    if (std::all_of(environments.begin(), environments.end(),
                    [](const EnvironmentLight& environment) { return environment.map < 0; }))
        return FieldDefect{"rotate_map", "it has no map that could be turned"};
    for (EnvironmentLight& environment : environments) {
        PolygonVertices portal = std::exchange(environment.portal, {});
        LightKind<EnvironmentLight>::transform(environment, scene::rotation(rotation.degrees, rotation.axis));
        environment.portal = std::move(portal);
    }
    return std::nullopt;
}

} // namespace nusselt::scene
