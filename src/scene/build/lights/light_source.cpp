#include "scene/build/lights/light_source.h"

#include "scene/build/lights/emission.h"
#include "scene/build/lights/emission_warnings.h"
#include "scene/colour/colour_space.h"
#include "scene/model/limits.h"
#include "scene/model/profiles/profile_radiance.h"
#include "scene/model/vector_math.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace nusselt::scene {

namespace {

Double3 texel_at(const Texture& texture, std::size_t index) {
    const auto channels = static_cast<std::size_t>(texture.channels);
    const float* const texel = texture.texels.data() + channels * index;
    return channels == 1 ? Double3{texel[0], texel[0], texel[0]} : Double3{texel[0], texel[1], texel[2]};
}

/// A sum over texels, each times a weight. \param weight function of column and row
template <class Weight>
Double3 weighted_sum(const Texture& texture, const Weight& weight) {
    Double3 sum;
    std::size_t index = 0;
    for (int row = 0; row < texture.height; ++row)
        for (int column = 0; column < texture.width; ++column, ++index)
            sum = sum + weight(column, row) * texel_at(texture, index);
    return sum;
}

/// The solid angle of the rectangle from (0, 0) to (x, y) in the plane at a distance of 1, with a sign.
double corner_solid_angle(double x, double y) { return std::atan(x * y / std::sqrt(1 + x * x + y * y)); }

/// The integral of an image over all directions, where each texel is constant [sr].
Double3 image_integral(const PointLight& light, const Texture* texture) {
    const double x = light.half_extent.x;
    const double y = light.half_extent.y;
    if (texture == nullptr) {
        const double whole = 4 * corner_solid_angle(x, y);
        return {whole, whole, whole};
    }
    const double width = texture->width;
    const double height = texture->height;
    switch (light.distribution) {
    case PointDistribution::latitude_image: {
        const auto cosine = [&](int row) { return std::cos(std::numbers::pi * row / height); };
        return weighted_sum(*texture, [&](int /*column*/, int row) {
            return 2 * std::numbers::pi / width * (cosine(row) - cosine(row + 1));
        });
    }
    case PointDistribution::projected_image: {
        const auto corner = [&](int column, int row) {
            return corner_solid_angle(x * (2 * column / width - 1), y * (2 * row / height - 1));
        };
        return weighted_sum(*texture, [&](int column, int row) {
            return corner(column + 1, row + 1) - corner(column, row + 1) - corner(column + 1, row) +
                   corner(column, row);
        });
    }
    default:
        return weighted_sum(
            *texture, [&](int /*column*/, int /*row*/) { return 4 * std::numbers::pi / (width * height); });
    }
}

std::string subject_of(const LightSourceDescription& source) { return std::string(source.kind); }

/// Sets what depends on the image.
void fit_image(const LightSourceDescription& source, const Texture* texture, PointLight& light) {
    if (texture != nullptr) {
        if (light.distribution == PointDistribution::octahedral_image && texture->width != texture->height)
            throw SceneError(source.origin, subject_of(source) + ": the image '" + texture->name +
                                                "' must be square, as equal-area maps are, but has " +
                                                std::to_string(texture->width) + " x " +
                                                std::to_string(texture->height) + " pixels");
        const double aspect = static_cast<double>(texture->width) / texture->height;
        light.half_extent.x = static_cast<float>(light.half_extent.x * std::max(aspect, 1.0));
        light.half_extent.y = static_cast<float>(light.half_extent.y * std::max(1 / aspect, 1.0));
    }
    const Double3 integral = image_integral(light, texture);
    const double largest = std::max({integral.x, integral.y, integral.z});
    if (!(largest <= kMaxRadiance))
        throw SceneError(source.origin,
                         subject_of(source) + ": the image '" + texture->name +
                             "' is too bright; its integral over all directions must be at most " +
                             to_text(kMaxRadiance) + " sr, found " + to_text(largest));
    light.image_integral = lit_channels(to_float(integral));
}

/// Gives a light its luminaire. Its intensity becomes that of the peak.
void set_luminaire(const LightSourceDescription& source, PointLight& light, BuiltShape& shapes) {
    const auto& luminaires = shapes.luminaires;
    const auto found = std::find(luminaires.begin(), luminaires.end(), source.luminaire);
    light.profile = static_cast<std::int32_t>(found - luminaires.begin());
    if (found == luminaires.end()) shapes.luminaires.push_back(source.luminaire);
    set_profile(*source.luminaire, light);
    if (!source.power)
        light.intensity = to_float((source.luminaire->profile.peak().candelas / kLumensPerWatt) *
                                   to_double(light.intensity));
}

/// The maps of the environments of a scene. Those with the same image or the same sky share one, and it is made once.
class EnvironmentMaps {
public:
    struct Map {
        std::shared_ptr<const EnvironmentMapTexels> texels;
        Double3 irradiance;      ///< see irradiance_of()
        std::int32_t index = -1; ///< in the scene; negative until a light takes it
    };

    /// \param make a function without parameters that returns the map
    template <class Make>
    Map& find(const LightSourceDescription& source, std::int32_t image, const Make& make) {
        for (auto& [key, map] : maps_)
            if (key.image == image && key.sky == source.sky) return map;
        const auto texels = std::make_shared<const EnvironmentMapTexels>(make());
        return maps_.emplace_back(Key{image, source.sky}, Map{texels, irradiance_of(*texels)}).second;
    }

private:
    struct Key {
        std::int32_t image; ///< index of a texture; negative for skies
        std::optional<SkyDescription> sky;
    };
    std::deque<std::pair<Key, Map>> maps_;
};

/// What lights are made of.
struct Parts {
    const std::vector<Texture>& textures; ///< of the scene
    EnvironmentMaps maps;
    BuiltShape& shapes;
};

Darkness finish(const LightSourceDescription& source, Parts& parts, PointLight& light) {
    if (source.luminaire != nullptr) {
        if (Darkness black = darkness(*source.luminaire)) return black;
        set_luminaire(source, light, parts.shapes);
    }
    const Texture* const image =
        light.texture < 0 ? nullptr : &parts.textures[static_cast<std::size_t>(light.texture)];
    if (is_image(light.distribution)) fit_image(source, image, light);
    const Double3 directions = solid_angle(light);
    if (image != nullptr && is_black(to_float(per_channel_product(directions, to_double(light.intensity)))))
        return black_image(image->name);
    if (source.power)
        light.intensity = to_float((*source.power / luminance(directions)) * to_double(light.intensity));
    check_emission(light.intensity, kIntensity, subject_of(source), source.origin);
    return std::nullopt;
}

Darkness finish(const LightSourceDescription& /*source*/, const Parts& /*parts*/,
                const DistantLight& /*light*/) {
    return std::nullopt;
}

/// The kind of an image, which is that in latitudes if its proportions do not tell.
EnvironmentImage image_kind(const LightSourceDescription& source, const Texture& image, Warnings& warnings) {
    const std::optional<EnvironmentImage> kind = image_kind(image);
    if (!kind)
        warnings.add(source.origin,
                     subject_of(source) + ": the image '" + image.name +
                         "' is neither square nor twice as wide as high; it is taken for one in "
                         "latitudes and longitudes");
    return kind.value_or(EnvironmentImage::latitude);
}

Darkness finish(const LightSourceDescription& source, Parts& parts, EnvironmentLight& light) {
    Double3 irradiance = {std::numbers::pi, std::numbers::pi, std::numbers::pi};
    if (light.map >= 0 || source.sky) {
        const auto of_image = [&] {
            const Texture& image = parts.textures[static_cast<std::size_t>(light.map)];
            return make_environment_map_texels(image, image_kind(source, image, parts.shapes.warnings));
        };
        EnvironmentMaps::Map& map = parts.maps.find(
            source, light.map, [&] { return source.sky ? make_sky_map(*source.sky) : of_image(); });
        irradiance = map.irradiance;
        light.radiance = per_channel_product(light.radiance, map.texels->mean);
        if (is_black(light.radiance)) return black_image(map.texels->name);
        std::vector<std::shared_ptr<const EnvironmentMapTexels>>& maps = parts.shapes.environment_maps;
        if (map.index < 0) {
            map.index = static_cast<std::int32_t>(maps.size());
            maps.push_back(map.texels);
        }
        light.map = map.index;
    }
    if (const double brightness = luminance(irradiance); source.irradiance && brightness > 0)
        light.radiance = to_float((*source.irradiance / brightness) * to_double(light.radiance));
    check_radiance(light.radiance, subject_of(source), source.origin);
    if (light.map < 0) return std::nullopt;
    const EnvironmentMapTexels& map = *parts.shapes.environment_maps[static_cast<std::size_t>(light.map)];
    light.radiance = lit_channels(light.radiance);
    if (is_black(light.radiance)) return black_image(map.name);
    check_radiance(brightest_radiance(light.radiance, map.mean, map.largest), subject_of(source),
                   source.origin);
    return std::nullopt;
}

} // namespace

std::optional<LightFrame> light_frame(const Transform& world_from_light) {
    const Double3 x = transform_vector(world_from_light, {1, 0, 0});
    const Double3 y = transform_vector(world_from_light, {0, 1, 0});
    const Double3 z = transform_vector(world_from_light, {0, 0, 1});
    const double sizes[] = {length(x), length(y), length(z)};
    const double volume = dot(cross(x, y), z);
    if (!(std::fabs(volume) > 0) || !std::isfinite(volume)) return std::nullopt;
    LightFrame frame;
    const Double3 z_axis = normalized(z);
    const Double3 x_axis = normalized(x - dot(x, z_axis) * z_axis);
    frame.z = to_float(z_axis);
    frame.x = to_float(x_axis);
    frame.y = to_float((volume > 0 ? 1.0 : -1.0) * cross(z_axis, x_axis));
    // Scene files round angles and matrices to a few digits.
    constexpr double kTolerance = 1e-3;
    const double largest = *std::max_element(std::begin(sizes), std::end(sizes));
    const double smallest = *std::min_element(std::begin(sizes), std::end(sizes));
    const double skew = std::max({std::fabs(dot(x, y)), std::fabs(dot(y, z)), std::fabs(dot(z, x))});
    frame.keeps_angles = largest - smallest <= kTolerance * largest && skew <= kTolerance * largest * largest;
    return frame;
}

void add_light_sources(const std::vector<LightSourceDescription>& sources,
                       const std::vector<Texture>& textures, BuiltShape& shapes) {
    Parts parts{textures, {}, shapes};
    for (const LightSourceDescription& source : sources) {
        const auto add = [&](auto light) {
            if (const Darkness darkness = finish(source, parts, light)) {
                warn_of_darkness(source.origin, subject_of(source), *darkness, shapes.warnings);
                return;
            }
            light.emitter = static_cast<std::uint32_t>(shapes.emitters.size());
            shapes.emitters.push_back({source.kind, source.origin});
            shapes.lights.of<decltype(light)>().push_back(light);
        };
        std::visit(add, source.light);
    }
}

} // namespace nusselt::scene
