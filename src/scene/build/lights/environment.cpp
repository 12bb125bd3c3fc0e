#include "scene/build/lights/environment.h"

#include "scene/model/vector_math.h"
#include "scene/sky/preetham_sky.h"

#include <nusselt/emission/latitude_longitude.h>
#include <nusselt/emission/octahedral_map.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tbb/parallel_for.h>

namespace nusselt::scene {

namespace {

constexpr int kSmallestMap = 16;
constexpr int kLargestMap = 4096;

/// An image with row 0 at the top.
class ImageLookup {
public:
    ImageLookup(const Texture& image, EnvironmentImage kind) : image_(image), kind_(kind) {}

    Double3 texel(int i, int j) const {
        const auto channels = static_cast<std::size_t>(image_.channels);
        const auto row = static_cast<std::size_t>(image_.height - 1 - j);
        const float* const texel =
            image_.texels.data() +
            channels * (row * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(i));
        return channels == 1 ? Double3{texel[0], texel[0], texel[0]} : Double3{texel[0], texel[1], texel[2]};
    }

    /// Interpolates between texels, across the border where directions do.
    Double3 operator()(const Vec3<double>& direction) const {
        const Vec2<double> at = kind_ == EnvironmentImage::latitude
                                    ? latitude_longitude_coordinates(direction)
                                    : octahedral_coordinates(direction);
        const double x = at.x * image_.width - 0.5;
        const double y = at.y * image_.height - 0.5;
        const int i = static_cast<int>(std::floor(x));
        const int j = static_cast<int>(std::floor(y));
        const double right = x - i;
        const double down = y - j;
        return (1 - down) * ((1 - right) * wrapped(i, j) + right * wrapped(i + 1, j)) +
               down * ((1 - right) * wrapped(i, j + 1) + right * wrapped(i + 1, j + 1));
    }

private:
    Double3 wrapped(int i, int j) const {
        if (kind_ == EnvironmentImage::octahedral) {
            const Vec2<int> at = wrap_octahedral(i, j, image_.width);
            return texel(at.x, at.y);
        }
        const int column = (i + image_.width) % image_.width;
        return texel(column, std::clamp(j, 0, image_.height - 1));
    }

    const Texture& image_;
    EnvironmentImage kind_;
};

bool is_power_of_two(int size) { return (size & (size - 1)) == 0; }

int map_size(const Texture& image) {
    const double side = std::sqrt(static_cast<double>(image.width) * image.height);
    int size = kSmallestMap;
    while (size < side && size < kLargestMap) size *= 2;
    return size;
}

/// The mean of a function over a texel. \param points on each side
template <class Function>
Double3 mean_over_texel(int i, int j, int size, int points, const Function& f) {
    Double3 sum;
    for (int k = 0; k < points * points; ++k)
        sum = sum + f(octahedral_direction(Vec2<double>{(i + (k % points + 0.5) / points) / size,
                                                        (j + (k / points + 0.5) / points) / size}));
    return (1.0 / (points * points)) * sum;
}

void fill_rows(const ImageLookup& lookup, bool keeps_texels, EnvironmentMapTexels& map) {
    // Small suns must not fall between the points.
    constexpr int kPoints = 4;
    tbb::parallel_for(0, map.size, [&](int j) {
        for (int i = 0; i < map.size; ++i)
            map.texels[static_cast<std::size_t>(j * map.size + i)] = to_float(
                keeps_texels ? lookup.texel(i, j) : mean_over_texel(i, j, map.size, kPoints, lookup));
    });
}

void set_mean_and_largest(EnvironmentMapTexels& map) {
    Double3 sum;
    for (const Float3& texel : map.texels) {
        sum = sum + to_double(texel);
        map.largest = per_channel_maximum(map.largest, texel);
    }
    map.mean = lit_channels(to_float((1.0 / static_cast<double>(map.texels.size())) * sum));
}

} // namespace

EnvironmentMapTexels make_sky_map(const SkyDescription& description) {
    const PreethamSky sky(description.turbidity, description.to_sun);
    EnvironmentMapTexels map;
    map.name = "sky";
    map.size = 1024;
    map.texels.resize(static_cast<std::size_t>(map.size) * static_cast<std::size_t>(map.size));
    const auto radiance = [&](const Vec3<double>& d) {
        const Double3 direction = {d.x, d.y, d.z};
        if (direction.z < 0) return Double3{};
        return sky.is_in_sun(direction) ? sky.sun_radiance() : sky.sky_radiance(direction);
    };
    const auto for_each_texel = [&](const auto& change) {
        tbb::parallel_for(0, map.size, [&](int j) {
            for (int i = 0; i < map.size; ++i) {
                const Vec3<double> centre =
                    octahedral_direction(Vec2<double>{(i + 0.5) / map.size, (j + 0.5) / map.size});
                // The disk of the sun is a few texels wide, and the horizon is an edge.
                const bool is_near_sun = dot(Double3{centre.x, centre.y, centre.z}, sky.to_sun()) > 1 - 1e-4;
                const bool is_near_horizon = std::fabs(centre.z) < 8.0 / map.size;
                change(map.texels[static_cast<std::size_t>(j * map.size + i)], i, j,
                       is_near_sun       ? 32
                       : is_near_horizon ? 8
                                         : 1);
            }
        });
    };
    for_each_texel([&](Float3& texel, int i, int j, int points) {
        texel = to_float(mean_over_texel(i, j, map.size, points, radiance));
    });
    const Double3 ground =
        (1 / std::numbers::pi) * per_channel_product(to_double(description.ground), irradiance_of(map));
    for_each_texel([&](Float3& texel, int i, int j, int points) {
        const auto below = [&](const Vec3<double>& d) { return d.z < 0 ? ground : Double3{}; };
        texel = to_float(to_double(texel) + mean_over_texel(i, j, map.size, points, below));
    });
    set_mean_and_largest(map);
    return map;
}

std::optional<EnvironmentImage> image_kind(const Texture& image) {
    if (image.width == image.height) return EnvironmentImage::octahedral;
    if (image.width == 2 * image.height) return EnvironmentImage::latitude;
    return std::nullopt;
}

EnvironmentMapTexels make_environment_map_texels(const Texture& image, EnvironmentImage kind) {
    EnvironmentMapTexels map;
    map.name = image.name;
    map.path = image.path;
    map.size = map_size(image);
    map.texels.resize(static_cast<std::size_t>(map.size) * static_cast<std::size_t>(map.size));
    const bool keeps_texels = kind == EnvironmentImage::octahedral && image.width == map.size &&
                              image.height == map.size && is_power_of_two(image.width);
    fill_rows(ImageLookup(image, kind), keeps_texels, map);
    set_mean_and_largest(map);
    return map;
}

Double3 irradiance_of(const EnvironmentMapTexels& map) {
    Double3 sum;
    for (int j = 0; j < map.size; ++j) {
        for (int i = 0; i < map.size; ++i) {
            const Vec3<double> direction =
                octahedral_direction(Vec2<double>{(i + 0.5) / map.size, (j + 0.5) / map.size});
            if (direction.z > 0)
                sum = sum + direction.z * to_double(map.texels[static_cast<std::size_t>(j * map.size + i)]);
        }
    }
    return (4 * std::numbers::pi / (static_cast<double>(map.size) * map.size)) * sum;
}

} // namespace nusselt::scene
